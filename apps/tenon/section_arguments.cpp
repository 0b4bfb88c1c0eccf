#include "section_arguments.h"

#include <cmath>

#include "commands.h"
#include "numbers.h"

namespace tenon {

namespace {

// `x`, `-y`, `z=3`: the side of larger, or with a minus of smaller, coordinates; through the middle or at a coordinate.
std::optional<SectionPlane> parse_axis_plane(std::string_view text) {
  const bool downward = text.substr(0, 1) == "-";
  if (downward || text.substr(0, 1) == "+") text.remove_prefix(1);
  if (text.empty() || text[0] < 'x' || text[0] > 'z') return std::nullopt;
  SectionPlane plane;
  plane.normal[text[0] - 'x'] = downward ? -1 : 1;
  text.remove_prefix(1);
  if (text.empty()) return plane;
  if (text[0] != '=') return std::nullopt;
  const auto at = parse_number<double>(text.substr(1));
  if (!at) return std::nullopt;
  plane.d = downward ? -*at : *at;
  return plane;
}

std::optional<SectionPlane> parse_plane(std::string_view text) {
  if (const auto plane = parse_axis_plane(text)) return plane;
  const auto numbers = parse_numbers(text);
  if (!numbers || numbers->size() != 4) return std::nullopt;
  const SectionPlane plane{{(*numbers)[0], (*numbers)[1], (*numbers)[2]}, (*numbers)[3]};
  if (plane.normal == Vec3{}) return std::nullopt;
  return plane;
}

}  // namespace

void SectionArguments::add_to(CLI::App& command) {
  command
      .add_option("--cut", cuts,
                  "Section view: take away the points p with n·p > d, and close the solid there. Or an axis: x takes "
                  "the half of larger x away, -x the other; x=3 cuts there. With / between planes only what lies "
                  "beyond all of them goes, as in a quarter cut: -y/x. May be repeated")
      ->type_name("NX,NY,NZ,D")
      ->allow_extra_args(false);
}

Result<std::vector<SectionCut>> parse_cuts(const SectionArguments& arguments) {
  std::vector<SectionCut> cuts;
  for (const std::string& text : arguments.cuts) {
    cuts.emplace_back();
    for (std::string_view rest = text;;) {
      const std::size_t end = rest.find('/');
      const auto plane = parse_plane(rest.substr(0, end));
      if (!plane) {
        return usage_error("--cut takes a plane nx,ny,nz,d, such as 0,0,1,5, or an axis, such as -y or z=5, not '" +
                           std::string(rest.substr(0, end)) + "'");
      }
      cuts.back().planes.push_back(*plane);
      if (end == std::string_view::npos) break;
      rest.remove_prefix(end + 1);
    }
  }
  return cuts;
}

}  // namespace tenon
