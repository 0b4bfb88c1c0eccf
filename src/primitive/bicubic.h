#pragma once

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "primitive/bezier_patch.h"
#include "primitive/concept.h"
#include "primitive/mesh.h"

namespace tenon {

/// Bicubic patches (course, "Intersecting bicubic surfaces"): a surface, or, where they close it, the solid inside.
class Bicubic {
 public:
  static constexpr std::array<std::string_view, 3> bases{"bezier", "bspline", "betaspline"};
  static constexpr std::array<std::string_view, 4> methods{"interval", "resultant", "subdivision", "polygons"};

  ControlNets points{{{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}},
                      {{0, 1, 0}, {1, 1, 1}, {2, 1, 1}, {3, 1, 0}},
                      {{0, 2, 0}, {1, 2, 1}, {2, 2, 1}, {3, 2, 0}},
                      {{0, 3, 0}, {1, 3, 0}, {2, 3, 0}, {3, 3, 0}}}};
  Choice basis{0, bases};
  double bias = 1;
  double tension = 0;
  Choice method{0, methods};
  double size = 0.001;
  double steps = 16;
  bool hull = true;

  static constexpr std::string_view name = "bicubic", scad_name = "bicubic";
  static constexpr std::string_view doc = "Bicubic patches, a surface; the solid inside where they close one.";
  static constexpr bool bounded = true;
  static constexpr double relative_cost = 60;
  static constexpr auto fields() {
    return std::tuple{
        Field{"points", Unit::length, &Bicubic::points, "nets of control points: lists of rows of [x, y, z]"},
        Field{"basis", Unit::none, &Bicubic::basis, "blending: bezier, bspline or betaspline"},
        Field{"bias", Unit::none, &Bicubic::bias, "of a Beta-spline; 1 is none"},
        Field{"tension", Unit::none, &Bicubic::tension, "of a Beta-spline; 0 is none"},
        Field{"method", Unit::none, &Bicubic::method,
              "of finding crossings: interval, resultant, subdivision, polygons"},
        Field{"size", Unit::length, &Bicubic::size, "of the parts that subdivision ends with"},
        Field{"steps", Unit::none, &Bicubic::steps, "polygons along each side of a patch"},
        Field{"hull", Unit::none, &Bicubic::hull, "the surface alone; false for the solid inside a closed one"}};
  }

  void prepare();
  std::string check() const { return problem_; }

  double support(const Vec3& n) const;
  /// Faces: the patch and the place on it, for the normal there (but for polygons: those of the mesh).
  void spans(const LocalRay& ray, Spans& out) const;
  Region classify(const LocalBox& box) const;
  Vec3 normal(const Vec3& point, std::uint32_t face) const;

 private:
  struct Patch {
    BezierNet<Vec3> net;
    Box3 box;
  };
  // What follows from the fields; shared by all copies.
  struct Surface {
    std::vector<Patch> patches;
    std::vector<Box3> boxes;  // around parts of patches
    Mesh mesh;                // polygons along the patches
    double sense = 1;         // -1 where by_u × by_v faces inward
  };
  std::string find_problem() const;
  std::string split_into_patches(Surface& surface) const;
  double blur_of_start(const LocalRay& ray, std::uint32_t face) const;
  TriangleMesh polygons(const std::vector<Patch>& patches, std::size_t count) const;

  std::shared_ptr<const Surface> surface_;
  std::string problem_ = "bicubic is not prepared";
};

}  // namespace tenon
