#include "lang/field_arguments.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "lang/failure.h"
#include "lang/format.h"

namespace tenon::lang {

namespace {

// A list of exactly as many finite numbers. False when it is none.
template <std::size_t Count>
bool read_numbers(const Value& value, std::array<double, Count>& numbers) {
  const List* list = value.list();
  if (!list || list->items().size() != Count) return false;
  for (std::size_t i = 0; i < Count; ++i) {
    const double* number = list->items()[i].number();
    if (!number || !std::isfinite(*number)) return false;
    numbers[i] = *number;
  }
  return true;
}

std::vector<Plane> require_planes(const ModuleArguments& arguments, std::size_t index, std::string_view name) {
  const std::string message =
      "'" + std::string(name) + "' must be a list of planes [nx, ny, nz, d], where n.p <= d inside";
  const List* list = arguments[index].list();
  if (!list) fail(arguments.at(index), message);
  std::vector<Plane> planes;
  for (const Value& item : list->items()) {
    std::array<double, 4> n{};
    if (!read_numbers(item, n)) fail(arguments.at(index), message);
    planes.push_back({{n[0], n[1], n[2]}, n[3]});
  }
  return planes;
}

Outline require_outline(const ModuleArguments& arguments, std::size_t index, std::string_view name) {
  const std::string message = "'" + std::string(name) +
                              "' must be a list of loops, each a list of corners [x, y] or [x, y, bulge], where the "
                              "bulge of an arc to the next corner is the tangent of a quarter of its angle";
  const List* list = arguments[index].list();
  if (!list) fail(arguments.at(index), message);
  Outline outline;
  for (const Value& item : list->items()) {
    const List* corners = item.list();
    if (!corners) fail(arguments.at(index), message);
    auto& loop = outline.loops.emplace_back();
    for (const Value& corner : corners->items()) {
      const auto numbers = to_vec3(corner, 0);
      if (!numbers) fail(arguments.at(index), message);
      loop.push_back({numbers->x, numbers->y, numbers->z});
    }
  }
  return outline;
}

Choice require_choice(const ModuleArguments& arguments, std::size_t index, std::string_view name, Choice choice) {
  const String* given = arguments[index].string();
  const auto found = given ? std::find(choice.names.begin(), choice.names.end(), given->text()) : choice.names.end();
  if (found == choice.names.end()) {
    std::string all;
    for (const std::string_view known : choice.names) {
      all += std::string(all.empty()                    ? "\""
                         : known == choice.names.back() ? " or \""
                                                        : ", \"") +
             std::string(known) + '"';
    }
    fail(arguments.at(index), "'" + std::string(name) + "' must be " + all);
  }
  choice.index = static_cast<std::uint8_t>(found - choice.names.begin());
  return choice;
}

Box3 require_box(const ModuleArguments& arguments, std::size_t index, std::string_view name) {
  const List* list = arguments[index].list();
  const bool two = list && list->items().size() == 2;
  const auto lower = two ? to_vec3(list->items()[0]) : std::nullopt;
  const auto upper = two ? to_vec3(list->items()[1]) : std::nullopt;
  if (!lower || !upper) {
    fail(arguments.at(index), "'" + std::string(name) + "' must be two corners, [[x, y, z], [x, y, z]]");
  }
  return {min(*lower, *upper), max(*lower, *upper)};
}

QuadricCoefficients require_coefficients(const ModuleArguments& arguments, std::size_t index, std::string_view name) {
  QuadricCoefficients coefficients{};
  if (!read_numbers(arguments[index], coefficients)) {
    fail(arguments.at(index),
         "'" + std::string(name) + "' must be a list of ten numbers: those of x², y², z², xy, xz, yz, x, y, z and 1");
  }
  return coefficients;
}

PolynomialTerms require_terms(const ModuleArguments& arguments, std::size_t index, std::string_view name) {
  const auto fail_at = [&](const std::string& where) {
    fail(arguments.at(index), where + "'" + std::string(name) +
                                  "' must be a list of [i, j, k, a] with whole exponents i, j, k, for a x^i y^j z^k");
  };
  const List* list = arguments[index].list();
  if (!list) fail_at("");
  PolynomialTerms terms;
  for (const Value& item : list->items()) {
    std::array<double, 4> n{};
    constexpr double most_exponent = 1e6;  // the primitive has a word for those that are merely too large
    const auto is_exponent = [](double x) { return x == std::floor(x) && std::fabs(x) <= most_exponent; };
    if (!read_numbers(item, n) || !is_exponent(n[0]) || !is_exponent(n[1]) || !is_exponent(n[2])) {
      fail_at("term " + std::to_string(terms.size()) + " is none: ");
    }
    terms.push_back({static_cast<int>(n[0]), static_cast<int>(n[1]), static_cast<int>(n[2]), n[3]});
  }
  return terms;
}

std::optional<std::vector<Vec3>> to_points(const Value& value) {
  const List* list = value.list();
  if (!list) return std::nullopt;
  std::vector<Vec3> points;
  for (const Value& item : list->items()) {
    const auto point = to_vec3(item);
    if (!point) return std::nullopt;
    points.push_back(*point);
  }
  return points;
}

// Lists of points, or one list by itself.
std::optional<PointLists> to_point_lists(const Value& value) {
  const List* list = value.list();
  if (!list) return std::nullopt;
  if (auto single = to_points(value); single && !single->empty()) return PointLists{*std::move(single)};
  PointLists lists;
  for (const Value& item : list->items()) {
    auto points = to_points(item);
    if (!points) return std::nullopt;
    lists.push_back(*std::move(points));
  }
  return lists;
}

PointLists require_point_lists(const ModuleArguments& arguments, std::size_t index, std::string_view name) {
  auto lists = to_point_lists(arguments[index]);
  if (!lists) {
    fail(arguments.at(index), "'" + std::string(name) + "' must be a list of [x, y, z], or a list of such lists");
  }
  return *std::move(lists);
}

ControlNets require_nets(const ModuleArguments& arguments, std::size_t index, std::string_view name) {
  const List* list = arguments[index].list();
  ControlNets nets;
  // One net may stand by itself.
  if (auto single = to_point_lists(arguments[index]); single && !single->empty()) return {*std::move(single)};
  for (std::size_t i = 0; list && i < list->items().size(); ++i) {
    auto net = to_point_lists(list->items()[i]);
    if (!net) list = nullptr;
    if (net) nets.push_back(*std::move(net));
  }
  if (!list) {
    fail(arguments.at(index),
         "'" + std::string(name) + "' must be a net of control points, a list of rows of [x, y, z], or a list of nets");
  }
  return nets;
}

}  // namespace

FieldValue require_field(const ModuleArguments& arguments, std::size_t index, const FieldInfo& field) {
  if (!arguments.given(index)) return field.fallback;
  const std::string_view name = field.name;
  if (std::holds_alternative<double>(field.fallback)) return require_number(arguments, index, name);
  if (std::holds_alternative<Vec3>(field.fallback)) return require_vec3(arguments, index, name);
  if (std::holds_alternative<std::vector<Plane>>(field.fallback)) return require_planes(arguments, index, name);
  if (std::holds_alternative<Outline>(field.fallback)) return require_outline(arguments, index, name);
  if (const auto* choice = std::get_if<Choice>(&field.fallback)) return require_choice(arguments, index, name, *choice);
  if (std::holds_alternative<Box3>(field.fallback)) return require_box(arguments, index, name);
  if (std::holds_alternative<QuadricCoefficients>(field.fallback)) return require_coefficients(arguments, index, name);
  if (std::holds_alternative<PolynomialTerms>(field.fallback)) return require_terms(arguments, index, name);
  if (std::holds_alternative<PointLists>(field.fallback)) return require_point_lists(arguments, index, name);
  if (std::holds_alternative<ControlNets>(field.fallback)) return require_nets(arguments, index, name);
  const bool* truth = arguments[index].boolean();
  if (!truth) fail(arguments.at(index), "'" + std::string(name) + "' must be true or false");
  return *truth;
}

}  // namespace tenon::lang
