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

void SectionStyleArguments::add_to(CLI::App& command) {
  CLI::Option* hatched = command.add_flag(
      "--hatch", hatch, "Draw lines across the cut faces of a section view, each material its own way");
  command.add_option("--hatch-angle", angle, "Of the first material's lines against the picture's horizontal, degrees")
      ->needs(hatched)
      ->type_name("A")
      ->capture_default_str();
  command
      .add_option("--hatch-spacing", spacing,
                  "Between the first material's lines: in the scene's units, and the lines lie in the cut's plane; or "
                  "in pixels, such as 8px, and they lie in the picture. Otherwise by the solid's size")
      ->needs(hatched)
      ->type_name("S|Spx");
  command
      .add_option("--cut-light", light,
                  "Whether what a section view takes away still casts its shadows: keep, remove; cut faces are lit "
                  "either way")
      ->type_name("WHAT")
      ->capture_default_str()
      ->check(CLI::IsMember({"keep", "remove"}));
}

std::string SectionStyleArguments::words() const {
  std::string text;
  if (light != "remove") text += " --cut-light " + light;
  if (!hatch) return text;
  text += " --hatch --hatch-angle " + shortest(angle);
  if (!spacing.empty()) text += " --hatch-spacing " + spacing;
  return text;
}

Result<std::optional<HatchOptions>> plan_hatch(const SectionStyleArguments& arguments) {
  HatchOptions options;
  options.angle = arguments.angle;
  if (!std::isfinite(options.angle)) return usage_error("--hatch-angle takes degrees");
  std::string_view text = arguments.spacing;
  if (!text.empty()) {
    options.in_pixels = text.ends_with("px");
    if (options.in_pixels) text.remove_suffix(2);
    const auto spacing = parse_number<double>(text);
    if (!spacing || !(*spacing > 0) || !std::isfinite(*spacing)) {
      return usage_error(
          "--hatch-spacing takes a length above 0 in the scene's units, or in pixels, such as 8px, not '" +
          arguments.spacing + "'");
    }
    options.spacing = *spacing;
  }
  return arguments.hatch ? std::optional(options) : std::nullopt;
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
