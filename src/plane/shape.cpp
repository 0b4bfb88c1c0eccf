#include "plane/shape.h"

#include "plane/clip.h"

namespace tenon {

namespace {

using ClipperLib::Paths;

double largest_coordinate(const Shape& shape) {
  double largest = largest_coordinate(shape.outline);
  for (const Shape& part : shape.parts) largest = std::max(largest, largest_coordinate(part));
  return largest;
}

Paths polygons_of(const Shape& shape, Chords& chords) {
  if (shape.operation == Shape::Operation::outline) {
    return clip(ClipperLib::ctUnion, chords.add(shape.outline), {}, ClipperLib::pftEvenOdd);
  }
  std::vector<Paths> parts;
  for (const Shape& part : shape.parts) parts.push_back(polygons_of(part, chords));
  if (parts.empty()) return {};
  Paths result = std::move(parts.front());
  if (shape.operation == Shape::Operation::intersect) {
    for (std::size_t i = 1; i < parts.size(); ++i) result = clip(ClipperLib::ctIntersection, result, parts[i]);
    return result;
  }
  Paths others;
  for (std::size_t i = 1; i < parts.size(); ++i) others.insert(others.end(), parts[i].begin(), parts[i].end());
  if (shape.operation == Shape::Operation::subtract) return clip(ClipperLib::ctDifference, result, others);
  result.insert(result.end(), others.begin(), others.end());
  return parts.size() == 1 ? result : clip(ClipperLib::ctUnion, result, {});
}

}  // namespace

Outline resolve(const Shape& shape) {
  const double largest = largest_coordinate(shape);
  if (!has_grid(largest)) return {};
  Chords chords(largest);
  const Paths paths = polygons_of(shape, chords);
  chords.index();
  return recover_outline(chords, paths);
}

Outline resolve_winding(const Outline& outline) {
  const double largest = largest_coordinate(outline);
  if (!has_grid(largest)) return {};
  Chords chords(largest);
  const Paths paths = clip(ClipperLib::ctUnion, chords.add(outline), {});
  chords.index();
  return recover_outline(chords, paths);
}

}  // namespace tenon
