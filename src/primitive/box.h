#pragma once

#include <string>
#include <string_view>
#include <tuple>

#include "primitive/box_clip.h"
#include "primitive/box_tests.h"
#include "primitive/check.h"
#include "primitive/concept.h"

namespace tenon {

/// lower <= p <= upper: from the origin to `size`, or around the origin.
struct Box {
  Vec3 size{1, 1, 1};
  bool center = false;

  static constexpr std::string_view name = "cube", scad_name = "cube";
  static constexpr std::string_view doc = "A box along the axes, from the origin or around it.";
  static constexpr bool bounded = true;
  static constexpr double relative_cost = 1.7;
  static constexpr auto fields() {
    return std::tuple{Field{"size", Unit::length, &Box::size, "edge lengths"},
                      Field{"center", Unit::none, &Box::center, "around the origin"}};
  }

  std::string check() const {
    return check_lengths(name, {{"size.x", size.x}, {"size.y", size.y}, {"size.z", size.z}});
  }

  Vec3 lower() const { return center ? size * -0.5 : Vec3{}; }
  Vec3 upper() const { return center ? size * 0.5 : size; }

  double support(const Vec3& n) const { return box_support({lower(), upper()}, n); }

  /// Faces: 2 axis for the lower one, 2 axis + 1 for the upper.
  void spans(const LocalRay& ray, Spans& out) const {
    Chord chord;
    if (clip_box(ray, {lower(), upper()}, 0, chord)) emit_chord(chord, out);
  }

  Region classify(const LocalBox& box) const {
    const Box3 solid{lower(), upper()};
    if (!solid.overlaps(box.bounds)) return Region::outside;
    if (solid.contains(box.bounds)) return Region::inside;
    return is_separated_by_box_faces(box, *this) ? Region::outside : Region::straddles;
  }

  std::uint32_t face_count() const { return 6; }
  Vec3 normal(const Vec3&, std::uint32_t face) const { return box_face_normal(face); }
};

}  // namespace tenon
