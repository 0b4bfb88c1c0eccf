#include <cmath>
#include <map>
#include <numbers>
#include <optional>
#include <set>

#include "base/text_scanner.h"
#include "drawing/dxf_groups.h"
#include "drawing/load_drawing.h"
#include "drawing/spline.h"
#include "plane/arc_corners.h"
#include "plane/arc_fit.h"
#include "plane/mapped_outline.h"

namespace tenon {

namespace {

// More strokes than a drawing can mean: blocks that insert one another double with each level.
constexpr std::size_t most_strokes = 4'000'000;
constexpr int deepest_insert = 16;
// What lies further out cannot be computed with (check_outline), and is no drawing.
constexpr double farthest = 1e60;
// Curves that DXF has and outlines do not become arcs within this part of their size.
constexpr double curve_tolerance = 0x1p-20;

struct Block {
  Vec2 base;
  std::vector<DxfEntity> entities;
};

Vec2 point_of(const DxfEntity& entity, int code) {
  return {entity.number(code), entity.number(code + 10)};
}

Vec2 on_circle(const Vec2& center, double r, double degrees) {
  return center + r * Vec2{cos_degrees(degrees), sin_degrees(degrees)};
}

// Entities of the plane may be seen from below: then x points the other way.
Affine3 facing(const DxfEntity& entity) {
  return entity.number(230, 1) < 0 ? Affine3::scale({-1, 1, 1}) : Affine3();
}

/// Makes a drawing of the entities of a file.
class DxfReader {
 public:
  explicit DxfReader(const InputFile& file) : file_(file) {}

  Result<Drawing> read() {
    Result<std::vector<DxfGroup>> groups = read_dxf_groups(file_);
    if (!groups) return groups.error();
    sort(entities_of(*groups));
    draw_all(entities_, {}, std::nullopt, 0);
    if (problem_) return *problem_;
    for (const std::string& kind : left_out_) {
      drawing_.notes.push_back(kind + " is no line of an outline; it is left out");
    }
    return std::move(drawing_);
  }

 private:
  // Into blocks and what is drawn.
  void sort(const std::vector<DxfEntity>& all) {
    std::string_view section;
    Block* block = nullptr;
    for (const DxfEntity& entity : all) {
      if (entity.type == "SECTION") {
        section = entity.text(2);
      } else if (entity.type == "ENDSEC") {
        section = {};
      } else if (section == "BLOCKS" && entity.type == "BLOCK") {
        block = &blocks_[std::string(entity.text(2))];
        *block = {point_of(entity, 10), {}};
      } else if (section == "BLOCKS" && entity.type == "ENDBLK") {
        block = nullptr;
      } else if (section == "BLOCKS" && block) {
        block->entities.push_back(entity);
      } else if (section == "ENTITIES") {
        entities_.push_back(entity);
      }
    }
  }

  // On the layer of the insert around them, where there is one.
  void draw_all(const std::vector<DxfEntity>& entities, const Affine3& map, std::optional<std::uint32_t> layer,
                int depth) {
    for (std::size_t i = 0; i < entities.size() && !problem_; ++i) {
      if (++drawn_ > most_strokes) return fail_as_too_large();
      layer_ = layer ? *layer : layer_of(entities[i]);
      if (entities[i].type == "POLYLINE") {
        i = draw_old_polyline(entities, i, map);
      } else {
        draw(entities[i], map, depth);
      }
    }
  }

  void draw(const DxfEntity& entity, const Affine3& map, int depth) {
    using Drawer = void (DxfReader::*)(const DxfEntity&, const Affine3&);
    static const std::map<std::string_view, Drawer> drawers{
        {"LINE", &DxfReader::draw_line},         {"LWPOLYLINE", &DxfReader::draw_polyline},
        {"CIRCLE", &DxfReader::draw_circle},     {"ARC", &DxfReader::draw_arc},
        {"ELLIPSE", &DxfReader::draw_ellipse},   {"SPLINE", &DxfReader::draw_spline},
        {"DIMENSION", &DxfReader::add_dimension}};
    if (entity.type == "INSERT") return insert(entity, map, depth);
    const auto found = drawers.find(entity.type);
    if (found != drawers.end()) return (this->*found->second)(entity, map);
    // Points and the like are not missed.
    static const std::set<std::string_view> harmless{"POINT", "VIEWPORT", "SEQEND", "ATTRIB", "ATTDEF"};
    if (!harmless.contains(entity.type)) left_out_.insert(TextScanner::printable(entity.type));
  }

  void draw_line(const DxfEntity& entity, const Affine3& map) {
    const Vec2 a = point_of(entity, 10), b = point_of(entity, 11);
    add({{a.x, a.y, 0}, {b.x, b.y, 0}}, false, map);
  }

  void draw_polyline(const DxfEntity& entity, const Affine3& map) {
    std::vector<OutlineCorner> way;
    for (const DxfGroup& group : entity.groups) {
      if (group.code == 10) way.push_back({group.number, 0, 0});
      if (way.empty()) continue;
      if (group.code == 20) way.back().y = group.number;
      if (group.code == 42) way.back().bulge = group.number;
    }
    add(way, (entity.integer(70) & 1) != 0, map * facing(entity));
  }

  // Its corners follow as entities of their own; returns the last of them.
  std::size_t draw_old_polyline(const std::vector<DxfEntity>& entities, std::size_t first, const Affine3& map) {
    const DxfEntity& entity = entities[first];
    const bool is_mesh = (entity.integer(70) & (16 | 64)) != 0;
    std::vector<OutlineCorner> way;
    std::size_t i = first;
    while (i + 1 < entities.size() && entities[i + 1].type == "VERTEX") {
      const DxfEntity& corner = entities[++i];
      // The control points of a curve that was fitted stand among the corners of the curve.
      if ((corner.integer(70) & 16) == 0) way.push_back({corner.number(10), corner.number(20), corner.number(42)});
    }
    if (is_mesh) {
      left_out_.insert("a POLYLINE that is a mesh");
    } else {
      add(way, (entity.integer(70) & 1) != 0, map * facing(entity));
    }
    return i;
  }

  void draw_circle(const DxfEntity& entity, const Affine3& map) {
    add(full_circle({point_of(entity, 10), std::fabs(entity.number(40))}, 1), true, map * facing(entity));
  }

  void draw_arc(const DxfEntity& entity, const Affine3& map) {
    const Vec2 center = point_of(entity, 10);
    const double r = entity.number(40), start = entity.number(50), end = entity.number(51);
    double turn = std::fmod(end - start, 360);
    if (turn <= 0) turn += 360;
    std::vector<OutlineCorner> way;
    add_arc(center, on_circle(center, r, start), turn * (std::numbers::pi / 180), way);
    const Vec2 last = on_circle(center, r, end);
    way.push_back({last.x, last.y, 0});
    add(way, false, map * facing(entity));
  }

  void draw_ellipse(const DxfEntity& entity, const Affine3& map) {
    const Vec2 center = point_of(entity, 10), major = point_of(entity, 11);
    const double ratio = entity.number(40, 1) * (entity.number(230, 1) < 0 ? -1 : 1);
    const Vec2 minor = ratio * Vec2{-major.y, major.x};
    constexpr double full = 2 * std::numbers::pi;
    const double start = entity.number(41), end = entity.number(42, full);
    double turn = std::fmod(end - start, full);
    if (turn <= 0) turn += full;
    const auto ellipse = [&](double t) { return center + std::cos(t) * major + std::sin(t) * minor; };
    std::vector<OutlineCorner> way;
    fit_arcs(ellipse, start, start + turn, curve_tolerance * (length(major) + length(minor)), way);
    const Vec2 last = turn == full ? ellipse(start) : ellipse(start + turn);
    way.push_back({last.x, last.y, 0});
    add(way, false, map);
  }

  void draw_spline(const DxfEntity& entity, const Affine3& map) {
    Spline spline;
    spline.degree = entity.integer(71, 3);
    for (const DxfGroup& group : entity.groups) {
      if (group.code == 40) spline.knots.push_back(group.number);
      if (group.code == 41) spline.weights.push_back(group.number);
      if (group.code == 10) spline.points.push_back({group.number, 0});
      if (group.code == 20 && !spline.points.empty()) spline.points.back().y = group.number;
    }
    if (const std::string problem = spline.check(); !problem.empty()) return fail(entity, problem);
    double size = 0;
    for (const Vec2& p : spline.points) size = std::max(size, length(p - spline.points.front()));
    std::vector<OutlineCorner> way;
    for (std::size_t i = static_cast<std::size_t>(spline.degree); i < spline.points.size(); ++i) {
      if (!(spline.knots[i] < spline.knots[i + 1])) continue;
      fit_arcs([&](double t) { return spline.point(t); }, spline.knots[i], spline.knots[i + 1], curve_tolerance * size,
               way);
    }
    const Vec2 last = spline.point(spline.end());
    way.push_back({last.x, last.y, 0});
    add(way, false, map);
  }

  void insert(const DxfEntity& entity, const Affine3& map, int depth) {
    const auto found = blocks_.find(std::string(entity.text(2)));
    if (found == blocks_.end()) {
      return fail(entity, "there is no block '" + TextScanner::printable(entity.text(2)) + "' in this file");
    }
    if (depth == deepest_insert) return fail(entity, "blocks insert one another more than 16 deep, or in a circle");
    const Block& block = found->second;
    const Vec2 at = point_of(entity, 10);
    const Affine3 here =
        map * facing(entity) * Affine3::translate({at.x, at.y, 0}) * Affine3::rotate(entity.number(50), {0, 0, 1});
    const Affine3 scale = Affine3::scale({entity.number(41, 1), entity.number(42, 1), 1}) *
                          Affine3::translate({-block.base.x, -block.base.y, 0});
    const std::uint32_t layer = layer_;
    const int columns = std::max(1, entity.integer(70, 1)), rows = std::max(1, entity.integer(71, 1));
    for (int column = 0; column < columns && !problem_; ++column) {
      for (int row = 0; row < rows && !problem_; ++row) {
        const Vec3 aside{column * entity.number(44), row * entity.number(45), 0};
        draw_all(block.entities, here * Affine3::translate(aside) * scale, layer, depth + 1);
        // Copies of nothing would take their time, too.
        if (block.entities.empty()) return;
      }
    }
  }

  void add_dimension(const DxfEntity& entity, const Affine3&) {
    Dimension dimension{std::string(entity.text(1)), layer_, entity.integer(70), entity.number(50), {}};
    for (int i = 0; i < 7; ++i) dimension.points[static_cast<std::size_t>(i)] = point_of(entity, 10 + i);
    drawing_.dimensions.push_back(std::move(dimension));
  }

  // The way ends at its last corner, or at its first one where it is closed.
  void add(const std::vector<OutlineCorner>& way, bool closed, const Affine3& map) {
    if (way.size() < 2) return;
    const std::vector<OutlineCorner> image = mapped({{way}}, map).loops.front();
    const std::size_t count = closed ? image.size() : image.size() - 1;
    for (std::size_t i = 0; i < count && !problem_; ++i) {
      const OutlineCorner &a = image[i], &b = image[(i + 1) % image.size()];
      if (!(std::fabs(a.x) + std::fabs(a.y) + std::fabs(a.bulge) + std::fabs(b.x) + std::fabs(b.y) < farthest)) {
        problem_ = at_file(file_.path, "the drawing is too large to compute with; coordinates end at 1e60");
      } else if (drawing_.strokes.size() == most_strokes) {
        fail_as_too_large();
      } else {
        drawing_.strokes.push_back({{a.x, a.y}, {b.x, b.y}, a.bulge, layer_});
      }
    }
  }

  void fail_as_too_large() {
    problem_ = at_file(file_.path, "the drawing has more than 4 million lines, most of them by blocks");
  }

  std::uint32_t layer_of(const DxfEntity& entity) {
    const auto [known, is_new] =
        layers_.try_emplace(std::string(entity.text(8)), static_cast<std::uint32_t>(drawing_.layers.size()));
    if (is_new) drawing_.layers.push_back(known->first);
    return known->second;
  }

  void fail(const DxfEntity& entity, const std::string& message) {
    problem_ = Error{ErrorKind::input, message, {file_.path, entity.line, 1, TextScanner::printable(entity.type)}};
  }

  const InputFile& file_;
  std::map<std::string, Block> blocks_;
  std::vector<DxfEntity> entities_;
  std::map<std::string, std::uint32_t> layers_;
  std::uint32_t layer_ = 0;  // of what is being drawn
  std::size_t drawn_ = 0;    // entities, blocks' copies counted
  std::set<std::string> left_out_;
  Drawing drawing_;
  std::optional<Error> problem_;
};

}  // namespace

Result<Drawing> read_dxf(const InputFile& file) {
  return DxfReader(file).read();
}

}  // namespace tenon
