#include "drawing/svg.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <pugixml.hpp>
#include <set>

#include "base/text_scanner.h"
#include "drawing/svg_path.h"
#include "plane/arc_corners.h"
#include "plane/mapped_outline.h"
#include "plane/shape.h"
#include "primitive/outline_edges.h"

namespace tenon {

namespace {

// `use` within `use` may double with each level.
constexpr std::size_t most_elements = 200'000;
constexpr int deepest = 100;
constexpr double farthest = 1e30;

std::string_view trimmed(std::string_view text) {
  const auto begin = text.find_first_not_of(" \t\r\n,");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r\n,") - begin + 1);
}

// The numbers of a list, up to what is none.
std::vector<double> numbers_of(std::string_view text) {
  std::vector<double> numbers;
  for (;;) {
    text = trimmed(text);
    if (!text.empty() && text.front() == '+') text.remove_prefix(1);
    double value = 0;
    const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (problem != std::errc() || !std::isfinite(value)) return numbers;
    numbers.push_back(value);
    text.remove_prefix(static_cast<std::size_t>(end - text.data()));
  }
}

/// A number with a unit.
struct Length {
  double number = 0;
  std::string_view unit;

  /// In millimetres; a percentage of a length of as many user units.
  double millimetres(double dpi, double whole) const {
    const std::pair<std::string_view, double> units[] = {{"mm", 1},          {"cm", 10},
                                                         {"in", 25.4},       {"pt", 25.4 / 72},
                                                         {"pc", 25.4 / 6},   {"%", whole / 100 * 25.4 / dpi},
                                                         {"px", 25.4 / dpi}, {"", 25.4 / dpi}};
    for (const auto& [name, size] : units) {
      if (unit == name) return number * size;
    }
    return number * 25.4 / dpi;
  }
};

std::optional<Length> length_of(const pugi::xml_attribute& attribute) {
  const std::string_view text = trimmed(attribute.value());
  double value = 0;
  const auto [end, problem] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (problem != std::errc() || !std::isfinite(value)) return std::nullopt;
  return Length{value, trimmed(text.substr(static_cast<std::size_t>(end - text.data())))};
}

double number_of(const pugi::xml_node& node, const char* name, double fallback = 0) {
  const auto length = length_of(node.attribute(name));
  return length ? length->number : fallback;
}

// A property of the `style` attribute, or the attribute of that name.
std::string property(const pugi::xml_node& node, const char* name) {
  const std::string style = node.attribute("style").value();
  const std::string wanted = std::string(name) + ':';
  for (std::size_t at = 0; at < style.size();) {
    const std::size_t end = std::min(style.find(';', at), style.size());
    std::string part(trimmed(std::string_view(style).substr(at, end - at)));
    std::erase(part, ' ');
    if (part.starts_with(wanted)) return part.substr(wanted.size());
    at = end + 1;
  }
  return std::string(trimmed(node.attribute(name).value()));
}

Affine3 plane_map(double a, double b, double c, double d, double e, double f) {
  return {{{{a, c, 0, e}, {b, d, 0, f}, {0, 0, 1, 0}}}};
}

// One function of a `transform` attribute; the identity where its arguments are none that it takes.
Affine3 transform_of(std::string_view name, const std::vector<double>& v) {
  const auto at = [&](std::size_t i, double fallback) { return i < v.size() ? v[i] : fallback; };
  if (v.empty()) return {};
  if (name == "translate") return Affine3::translate({v[0], at(1, 0), 0});
  if (name == "scale") return Affine3::scale({v[0], at(1, v[0]), 1});
  if (name == "rotate") {
    const Vec3 center{at(1, 0), at(2, 0), 0};
    return Affine3::translate(center) * Affine3::rotate(v[0], {0, 0, 1}) * Affine3::translate(-center);
  }
  if (name == "skewX") return plane_map(1, 0, sin_degrees(v[0]) / cos_degrees(v[0]), 1, 0, 0);
  if (name == "skewY") return plane_map(1, sin_degrees(v[0]) / cos_degrees(v[0]), 0, 1, 0, 0);
  if (name == "matrix" && v.size() == 6) return plane_map(v[0], v[1], v[2], v[3], v[4], v[5]);
  return {};
}

Affine3 transforms_of(std::string_view text) {
  Affine3 map;
  for (;;) {
    const std::size_t open = text.find('('), close = text.find(')');
    if (open == std::string_view::npos || close == std::string_view::npos || close < open) return map;
    map = map * transform_of(trimmed(text.substr(0, open)), numbers_of(text.substr(open + 1, close - open - 1)));
    text.remove_prefix(close + 1);
  }
}

/// What a group hands down to what is in it.
struct Inherited {
  Affine3 map;
  bool filled = true, even_odd = false;
  bool taken = true;  // within the layer and the element that were asked for
};

class SvgReader {
 public:
  SvgReader(const InputFile& file, const SvgOptions& options) : file_(file), options_(options) {}

  Result<SvgPicture> read() {
    pugi::xml_document document;
    const pugi::xml_parse_result parsed = document.load_buffer(file_.bytes.data(), file_.bytes.size());
    if (!parsed) {
      return at_byte(parsed.offset, std::string("this is no XML: ") + parsed.description());
    }
    const pugi::xml_node root = document.document_element();
    if (local_name(root) != "svg") return at_byte(root.offset_debug(), "an SVG file begins with <svg>");
    add_ids(root, 0);
    Inherited inherited;
    inherited.taken = options_.id.empty() && options_.layer.empty();
    walk_children(root, inherited, 0);
    if (problem_) return *problem_;
    for (const std::string& name : left_out_) picture_.notes.push_back(name + " is left out");
    if (not_filled_) picture_.notes.push_back("lines that are not filled are left out");
    place(root);
    if (problem_) return *problem_;
    return std::move(picture_);
  }

 private:
  static std::string_view local_name(const pugi::xml_node& node) {
    const std::string_view name = node.name();
    const std::size_t colon = name.find(':');
    return colon == std::string_view::npos ? name : name.substr(colon + 1);
  }

  Error at_byte(std::ptrdiff_t offset, const std::string& message) const {
    const std::size_t at = std::min(static_cast<std::size_t>(std::max<std::ptrdiff_t>(offset, 0)), file_.bytes.size());
    const std::string_view before(file_.bytes.data(), at);
    const auto line = std::count(before.begin(), before.end(), '\n');
    const std::size_t begin = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
    const std::size_t end = std::min(file_.bytes.find('\n', at), file_.bytes.size());
    return Error{ErrorKind::input,
                 message,
                 {file_.path, static_cast<int>(line) + 1, static_cast<int>(at - begin) + 1,
                  TextScanner::printable(std::string_view(file_.bytes).substr(begin, end - begin))}};
  }

  void add_ids(const pugi::xml_node& node, int depth) {
    if (depth > deepest) return;
    if (const char* id = node.attribute("id").value(); *id != 0) ids_.emplace(id, node);
    for (const pugi::xml_node& child : node.children()) add_ids(child, depth + 1);
  }

  void walk_children(const pugi::xml_node& node, const Inherited& inherited, int depth) {
    for (const pugi::xml_node& child : node.children()) walk(child, inherited, depth + 1);
  }

  void walk(const pugi::xml_node& node, Inherited inherited, int depth) {
    if (problem_ || node.type() != pugi::node_element) return;
    if (depth > deepest || ++walked_ > most_elements) {
      problem_ =
          at_byte(node.offset_debug(), "elements are nested more than 100 deep, or used more than 200,000 times");
      return;
    }
    const std::string_view name = local_name(node);
    if (property(node, "display") == "none") return;
    inherited.map = inherited.map * transforms_of(node.attribute("transform").value());
    if (const std::string fill = property(node, "fill"); !fill.empty()) inherited.filled = fill != "none";
    if (const std::string rule = property(node, "fill-rule"); !rule.empty()) inherited.even_odd = rule == "evenodd";
    const bool is_id = !options_.id.empty() && options_.id == node.attribute("id").value();
    const bool is_layer = !options_.layer.empty() && options_.layer == node.attribute("inkscape:label").value();
    inherited.taken = inherited.taken || is_id || is_layer;
    if (name == "g" || name == "svg" || name == "a" || name == "switch") return walk_children(node, inherited, depth);
    if (name == "use") return use(node, inherited, depth);
    if (const auto outline = outline_of(node, name)) {
      if (inherited.taken) add(node, *outline, inherited);
      return;
    }
    static const std::set<std::string_view> drawn{"text", "image", "foreignObject", "tspan"};
    if (drawn.contains(name) && inherited.taken) left_out_.insert(std::string(name));
  }

  void use(const pugi::xml_node& node, Inherited inherited, int depth) {
    std::string_view reference = node.attribute("href").value();
    if (reference.empty()) reference = node.attribute("xlink:href").value();
    const auto found = reference.starts_with('#') ? ids_.find(std::string(reference.substr(1))) : ids_.end();
    if (found == ids_.end()) return;
    inherited.map = inherited.map * Affine3::translate({number_of(node, "x"), number_of(node, "y"), 0});
    if (local_name(found->second) == "symbol") return walk_children(found->second, inherited, depth + 1);
    walk(found->second, inherited, depth + 1);
  }

  // In the element's own coordinates; nothing where it is no shape.
  std::optional<Outline> outline_of(const pugi::xml_node& node, std::string_view name) {
    if (name == "path") {
      auto outline = parse_svg_path(node.attribute("d").value());
      if (!outline) problem_ = at_byte(node.offset_debug(), "the data of this path cannot be read");
      return outline;
    }
    if (name == "polygon" || name == "polyline") {
      const std::vector<double> numbers = numbers_of(node.attribute("points").value());
      Outline outline;
      auto& loop = outline.loops.emplace_back();
      for (std::size_t i = 0; i + 1 < numbers.size(); i += 2) loop.push_back({numbers[i], numbers[i + 1], 0});
      return outline;
    }
    const Vec2 center{number_of(node, "cx"), number_of(node, "cy")};
    if (name == "circle") return Outline{{full_circle({center, number_of(node, "r")}, 1)}};
    if (name == "ellipse") {
      const double rx = number_of(node, "rx"), ry = number_of(node, "ry");
      return mapped({{full_circle({{0, 0}, 1}, 1)}}, plane_map(rx, 0, 0, ry, center.x, center.y));
    }
    if (name == "rect") return rectangle(node);
    return std::nullopt;
  }

  static Outline rectangle(const pugi::xml_node& node) {
    const double x = number_of(node, "x"), y = number_of(node, "y"), w = number_of(node, "width"),
                 h = number_of(node, "height");
    const bool has_x = length_of(node.attribute("rx")).has_value();
    double rx = number_of(node, "rx", number_of(node, "ry")), ry = has_x ? number_of(node, "ry", rx) : rx;
    if (length_of(node.attribute("ry")) && !has_x) rx = ry = number_of(node, "ry");
    rx = std::clamp(rx, 0.0, std::fabs(w) / 2), ry = std::clamp(ry, 0.0, std::fabs(h) / 2);
    if (rx == 0 || ry == 0) return {{{{x, y, 0}, {x + w, y, 0}, {x + w, y + h, 0}, {x, y + h, 0}}}};
    // Round in units of the radii.
    const double a = w / rx, b = h / ry, quarter = std::sqrt(2.0) - 1;
    return mapped({{{{1, 0, 0},
                     {a - 1, 0, quarter},
                     {a, 1, 0},
                     {a, b - 1, quarter},
                     {a - 1, b, 0},
                     {1, b, quarter},
                     {0, b - 1, 0},
                     {0, 1, quarter}}}},
                  plane_map(rx, 0, 0, ry, x, y));
  }

  static bool is_closed(const pugi::xml_node& node) {
    const std::string_view data = trimmed(node.attribute("d").value());
    return local_name(node) == "path" ? data.ends_with('z') || data.ends_with('Z') : local_name(node) != "polyline";
  }

  void add(const pugi::xml_node& node, const Outline& outline, const Inherited& inherited) {
    // OpenSCAD fills what is closed, whatever its paint.
    if (!inherited.filled && !is_closed(node)) {
      not_filled_ = true;
      return;
    }
    Outline image = mapped(outline, inherited.map);
    std::erase_if(image.loops, [](const auto& loop) { return loop.size() < 2; });
    for (const auto& loop : image.loops) {
      for (const OutlineCorner& c : loop) {
        if (!(std::fabs(c.x) + std::fabs(c.y) + std::fabs(c.bulge) < farthest)) {
          problem_ = at_byte(node.offset_debug(), "this element is too large to compute with");
          return;
        }
      }
    }
    shapes_.parts.push_back(inherited.even_odd ? Shape::of(std::move(image)) : Shape::of(resolve_winding(image)));
  }

  // Onto the page, y upward, as OpenSCAD does it: without a viewBox a unit is a millimetre, and the corner of a viewBox
  // is taken off y twice.
  void place(const pugi::xml_node& root) {
    const std::vector<double> box = numbers_of(root.attribute("viewBox").value());
    const bool has_box = box.size() == 4 && box[2] > 0 && box[3] > 0;
    const auto width = length_of(root.attribute("width")), height = length_of(root.attribute("height"));
    const double whole_x = has_box ? box[2] : 0, whole_y = has_box ? box[3] : 0;
    const Vec2 page{width.value_or(Length{100, "%"}).millimetres(options_.dpi, whole_x),
                    height.value_or(Length{100, "%"}).millimetres(options_.dpi, whole_y)};
    Affine3 map = plane_map(1, 0, 0, -1, 0, page.y);
    if (has_box) {
      const std::string_view fit = root.attribute("preserveAspectRatio").value();
      Vec2 scale{page.x / box[2], page.y / box[3]}, rest;
      if (fit.find("none") == std::string_view::npos) {
        const bool slice = fit.find("slice") != std::string_view::npos;
        scale.x = scale.y = slice ? std::max(scale.x, scale.y) : std::min(scale.x, scale.y);
        const auto part = [&](const char* least, const char* most) {
          return fit.find(least) != std::string_view::npos ? 0.0 : fit.find(most) != std::string_view::npos ? 1.0 : 0.5;
        };
        rest = {part("xMin", "xMax") * (page.x - scale.x * box[2]), part("YMin", "YMax") * (page.y - scale.y * box[3])};
      }
      map = plane_map(scale.x, 0, 0, -scale.y, rest.x - scale.x * box[0], page.y - rest.y - scale.y * box[1]);
    }
    picture_.outline = mapped(resolve(shapes_), map);
    if (!options_.center || picture_.outline.loops.empty()) return;
    const OutlineEdges edges(picture_.outline);
    const Vec2 middle = 0.5 * (edges.lower() + edges.upper());
    picture_.outline = mapped(picture_.outline, Affine3::translate({-middle.x, -middle.y, 0}));
  }

  const InputFile& file_;
  const SvgOptions& options_;
  std::map<std::string, pugi::xml_node> ids_;
  std::size_t walked_ = 0;
  Shape shapes_;
  std::set<std::string> left_out_;
  bool not_filled_ = false;
  SvgPicture picture_;
  std::optional<Error> problem_;
};

}  // namespace

Result<SvgPicture> read_svg(const InputFile& file, const SvgOptions& options) {
  return SvgReader(file, options).read();
}

}  // namespace tenon
