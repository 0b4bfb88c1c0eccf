#include "mesh/height_map.h"

#include <algorithm>

#include "base/text_scanner.h"
#include "mesh/png_heights.h"

namespace tenon {

namespace {

// Four triangles a point: as many as a machine of some gigabytes holds.
constexpr std::size_t most_points = std::size_t{1} << 22;

Result<Heights> read_text_heights(const MeshFile& file) {
  TextScanner scanner(file.path, file.bytes);
  std::vector<std::vector<double>> rows;
  Heights heights;
  std::size_t points = 0;
  while (scanner.next_content_line()) {
    std::vector<double>& row = rows.emplace_back();
    for (std::string_view word = scanner.word(); !word.empty(); word = scanner.word()) {
      const auto number = to_number(word);
      if (!number) return scanner.error("'" + TextScanner::printable(word) + "' is no finite number");
      row.push_back(*number);
      heights.bottom = std::min(heights.bottom, *number - 1);
    }
    heights.columns = std::max(heights.columns, row.size());
    points = rows.size() * heights.columns;
    if (points > most_points) {
      return scanner.error("the height map has more than " + std::to_string(most_points) + " points; thin it out");
    }
  }
  heights.rows = rows.size();
  heights.values.reserve(points);
  for (std::vector<double>& row : rows) {
    row.resize(heights.columns, 0);
    heights.values.insert(heights.values.end(), row.begin(), row.end());
  }
  return heights;
}

Result<Heights> read_picture_heights(const MeshFile& file, bool invert) {
  Result<Heights> heights = read_png_heights(file, most_points);
  if (!heights) return heights;
  for (double& value : heights->values) {
    value = (invert ? 1 - value : value) * 100 / 255;
    heights->bottom = std::min(heights->bottom, value - 1);
  }
  const auto columns = static_cast<std::ptrdiff_t>(heights->columns);
  auto top = heights->values.begin(), bottom = heights->values.end();
  for (; bottom - top > columns; top += columns, bottom -= columns)
    std::swap_ranges(top, top + columns, bottom - columns);
  return heights;
}

/// The solid between a height map and its bottom.
class Terrain {
 public:
  Terrain(const Heights& heights, bool center) : heights_(heights), bottom_(heights.bottom) {
    if (center) {
      x_ = -0.5 * static_cast<double>(heights.columns - 1);
      y_ = -0.5 * static_cast<double>(heights.rows - 1);
    }
  }

  PolygonSoup build() {
    for (std::size_t row = 0; row < heights_.rows; ++row) {
      for (std::size_t column = 0; column < heights_.columns; ++column) {
        add_point(column, row, heights_.values[row * heights_.columns + column]);
      }
    }
    for (std::size_t row = 1; row < heights_.rows; ++row) {
      for (std::size_t column = 1; column < heights_.columns; ++column) add_top(column, row);
    }
    middle_ = static_cast<std::uint32_t>(soup_.points.size());
    soup_.points.push_back({x_ + 0.5 * static_cast<double>(heights_.columns - 1),
                            y_ + 0.5 * static_cast<double>(heights_.rows - 1), bottom_});
    walk_border();
    return std::move(soup_);
  }

 private:
  void add_point(std::size_t column, std::size_t row, double z) {
    soup_.points.push_back({x_ + static_cast<double>(column), y_ + static_cast<double>(row), z});
  }
  std::uint32_t top(std::size_t column, std::size_t row) const {
    return static_cast<std::uint32_t>(row * heights_.columns + column);
  }

  // The square between four points, of which this is the one farthest from the first.
  void add_top(std::size_t column, std::size_t row) {
    const std::uint32_t corners[4] = {top(column - 1, row - 1), top(column, row - 1), top(column, row),
                                      top(column - 1, row)};
    Vec3 middle;
    for (const std::uint32_t corner : corners) middle += 0.25 * soup_.points[corner];
    const auto center = static_cast<std::uint32_t>(soup_.points.size());
    soup_.points.push_back(middle);
    for (std::size_t i = 0; i < 4; ++i) add_triangle(corners[i], corners[(i + 1) % 4], center);
  }

  // Around the border counterclockwise: a wall below each edge, and its part of the bottom.
  void walk_border() {
    const std::size_t right = heights_.columns - 1, back = heights_.rows - 1;
    const std::uint32_t first = add_foot(0, 0);
    std::uint32_t foot = first;
    std::size_t column = 0, row = 0;
    const auto step = [&](std::size_t next_column, std::size_t next_row) {
      const bool is_last = next_column == 0 && next_row == 0;
      const std::uint32_t next_foot = is_last ? first : add_foot(next_column, next_row);
      const std::uint32_t a = top(column, row), b = top(next_column, next_row);
      add_triangle(foot, next_foot, b);
      add_triangle(foot, b, a);
      add_triangle(next_foot, foot, middle_);
      column = next_column;
      row = next_row;
      foot = next_foot;
    };
    while (column < right) step(column + 1, row);
    while (row < back) step(column, row + 1);
    while (column > 0) step(column - 1, row);
    while (row > 0) step(column, row - 1);
  }
  std::uint32_t add_foot(std::size_t column, std::size_t row) {
    add_point(column, row, bottom_);
    return static_cast<std::uint32_t>(soup_.points.size() - 1);
  }

  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    const std::uint32_t corners[] = {a, b, c};
    soup_.add_face(corners);
  }

  const Heights& heights_;
  double x_ = 0, y_ = 0, bottom_;
  std::uint32_t middle_ = 0;
  PolygonSoup soup_;
};

}  // namespace

Result<PolygonSoup> read_height_map(const MeshFile& file, const HeightMapOptions& options) {
  // By its first bytes, which no text has.
  const bool is_picture = file.bytes.starts_with("\x89PNG");
  const Result<Heights> heights = is_picture ? read_picture_heights(file, options.invert) : read_text_heights(file);
  if (!heights) return heights.error();
  if (heights->rows < 2 || heights->columns < 2) {
    return Error{ErrorKind::input,
                 "a height map needs at least two rows and two columns, not " + std::to_string(heights->rows) +
                     " and " + std::to_string(heights->columns),
                 {file.path, 0, 0, {}}};
  }
  return Terrain(*heights, options.center).build();
}

}  // namespace tenon
