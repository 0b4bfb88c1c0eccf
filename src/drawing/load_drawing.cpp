#include "drawing/load_drawing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "drawing/join_strokes.h"
#include "tenon/math/affine3.h"

namespace tenon {

namespace {

// OpenSCAD's grid; or as little as files of six digits tell of large drawings.
constexpr double same_place = 1e-5;
constexpr double digits = 1e-6;

std::vector<Path> paths_of_layer(const Drawing& drawing, const std::string& layer) {
  std::vector<Stroke> strokes;
  double largest = 0;
  for (const Stroke& stroke : drawing.strokes) {
    if (!drawing.is_on(stroke.layer, layer)) continue;
    strokes.push_back(stroke);
    for (const Vec2& p : {stroke.from, stroke.to}) largest = std::max({largest, std::fabs(p.x), std::fabs(p.y)});
  }
  return join_strokes(strokes, std::max(same_place, digits * largest));
}

// From the y axis, as OpenSCAD has it.
double degrees(const Vec2& v) {
  return std::atan2(v.x, v.y) * (180 / std::numbers::pi);
}

}  // namespace

bool is_drawing(const std::string& path) {
  return ending_of(path) == ".dxf";
}

Result<Drawing> parse_drawing(const InputFile& file) {
  return read_dxf(file);
}

Result<Drawing> load_drawing(const std::string& path) {
  const Result<InputFile> file = read_input_file(path, "a drawing");
  if (!file) return file.error();
  return parse_drawing(*file);
}

void place(Drawing& drawing, const Vec2& origin, double scale) {
  const auto placed = [&](const Vec2& p) { return scale * (p - origin); };
  for (Stroke& stroke : drawing.strokes) {
    stroke.from = placed(stroke.from);
    stroke.to = placed(stroke.to);
  }
  for (Dimension& dimension : drawing.dimensions) {
    for (Vec2& p : dimension.points) p = placed(p);
  }
}

DrawnOutline outline_of_layer(const Drawing& drawing, const std::string& layer) {
  DrawnOutline result;
  for (Path& path : paths_of_layer(drawing, layer)) {
    const bool straight = std::all_of(path.corners.begin(), path.corners.end(),
                                      [](const OutlineCorner& corner) { return corner.bulge == 0; });
    // A line there and back encloses nothing.
    if (path.corners.size() < 2 || (path.corners.size() < 3 && straight)) continue;
    if (!path.closed) ++result.open_paths;
    result.outline.loops.push_back(std::move(path.corners));
  }
  return result;
}

Result<double> measure(const Drawing& drawing, const std::string& layer, const std::string& name) {
  for (const Dimension& dimension : drawing.dimensions) {
    if (!drawing.is_on(dimension.layer, layer) || (!name.empty() && dimension.name != name)) continue;
    const auto& p = dimension.points;
    const Vec2 along{cos_degrees(dimension.angle), sin_degrees(dimension.angle)};
    switch (dimension.type & 7) {
      case 0:  // rotated, horizontal or vertical
        return std::fabs(dot(p[4] - p[3], along));
      case 1:  // aligned
        return length(p[4] - p[3]);
      case 2:  // angular
        return std::fabs(degrees(p[0] - p[5]) - degrees(p[4] - p[3]));
      case 3:  // diameter
      case 4:  // radius
        return length(p[5] - p[0]);
      case 6:  // ordinate
        return (dimension.type & 64) != 0 ? p[3].x : p[3].y;
      default:
        return Error{
            ErrorKind::input, "a dimension of type " + std::to_string(dimension.type & 7) + " cannot be measured", {}};
    }
  }
  return Error{
      ErrorKind::input, "there is no dimension" + (name.empty() ? "" : " '" + name + "'") + " in the drawing", {}};
}

Result<Vec2> crossing(const Drawing& drawing, const std::string& layer) {
  std::vector<Vec2> ends;
  for (const Path& path : paths_of_layer(drawing, layer)) {
    if (path.corners.size() != 2 || path.closed || ends.size() == 4) continue;
    for (const OutlineCorner& corner : path.corners) ends.push_back({corner.x, corner.y});
  }
  if (ends.size() == 4) {
    const Vec2 u = ends[1] - ends[0], v = ends[3] - ends[2];
    const double turn = cross(u, v);
    if (turn != 0) return ends[0] + cross(ends[2] - ends[0], v) / turn * u;
  }
  return Error{ErrorKind::input, "the layer has no two lines that cross", {}};
}

}  // namespace tenon
