#include "view_arguments.h"

#include <cmath>

#include "commands.h"
#include "numbers.h"
#include "tenon/render/camera_rays.h"

namespace tenon {

namespace {

Result<Camera> parse_camera(const std::string& text) {
  const auto numbers = parse_numbers(text);
  if (!numbers || (numbers->size() != 6 && numbers->size() != 7)) {
    return usage_error(
        "--camera takes six or seven numbers, from-x,y,z,at-x,y,z[,fov], such as 10,-10,8,0,0,0,40, not '" + text +
        "'");
  }
  const std::vector<double>& n = *numbers;
  Camera camera;
  camera.from = {n[0], n[1], n[2]};
  camera.at = {n[3], n[4], n[5]};
  if (n.size() == 7) camera.fov = n[6];
  if (const auto rays = CameraRays::create(camera, 1, 1); !rays) return usage_error("--" + rays.error().message);
  return camera;
}

Result<ViewAngles> parse_angles(const std::string& text) {
  const auto numbers = parse_numbers(text);
  if (!numbers || numbers->size() != 2 || !(std::fabs((*numbers)[1]) <= 90) || !std::isfinite((*numbers)[0])) {
    return usage_error(
        "--view takes an azimuth (0 looks from +x, -90 from the front) and an elevation from -90 to 90, in degrees, "
        "such as -60,30, not '" +
        text + "'");
  }
  return ViewAngles{(*numbers)[0], (*numbers)[1]};
}

}  // namespace

void ViewArguments::add_to(CLI::App& command) {
  command
      .add_option("--camera", camera, "In place of the scene's camera: six numbers, and a horizontal angle in degrees")
      ->type_name("FROM,AT[,FOV]");
  command
      .add_option(
          "--view", angles,
          "Look at the whole solid from there: degrees around z (0 from +x, 90 from +y, -90 from the front) and "
          "above the xy-plane")
      ->type_name("AZ,EL");
  command
      .add_option("--aperture", aperture,
                  "Diameter of the camera's lens, in the scene's units: what is not in focus is blurred, the more the "
                  "larger it is")
      ->type_name("D")
      ->check(CLI::NonNegativeNumber);
  command
      .add_option("--focus", focus,
                  "What is sharp through a lens: a distance from the camera, or a point; else what it looks at")
      ->type_name("D|X,Y,Z");
  command.add_flag(
      "--fit", fit,
      "Move the camera, without turning it, until the whole solid fills the picture, with 2.5 % of its width "
      "or height free on each side");
  command.add_flag("--ortho,--orthographic", orthographic,
                   "Parallel rays, covering what the camera would see at the point it looks at");
}

std::string ViewArguments::words() const {
  std::string text;
  if (!camera.empty()) text += " --camera " + camera;
  if (!angles.empty()) text += " --view " + angles;
  if (aperture) text += " --aperture " + shortest(*aperture);
  if (!focus.empty()) text += " --focus " + focus;
  if (fit) text += " --fit";
  if (orthographic) text += " --orthographic";
  return text;
}

Result<ViewRequest> plan_view(const ViewArguments& arguments, double aspect) {
  ViewRequest request;
  if (!arguments.camera.empty()) {
    const Result<Camera> camera = parse_camera(arguments.camera);
    if (!camera) return camera.error();
    request.camera = *camera;
  }
  if (!arguments.angles.empty()) {
    const Result<ViewAngles> angles = parse_angles(arguments.angles);
    if (!angles) return angles.error();
    request.angles = *angles;
  }
  if (arguments.aperture.value_or(0) > 0 && arguments.orthographic) {
    return usage_error("parallel rays pass no lens; leave --aperture or --orthographic out");
  }
  request.aperture = arguments.aperture;
  if (!arguments.focus.empty()) {
    const auto numbers = parse_numbers(arguments.focus);
    if (!numbers || (numbers->size() != 1 && numbers->size() != 3)) {
      return usage_error("--focus takes a distance or a point x,y,z, not '" + arguments.focus + "'");
    }
    if (numbers->size() == 1) {
      request.focus = (*numbers)[0];
    } else {
      request.focus_point = Vec3{(*numbers)[0], (*numbers)[1], (*numbers)[2]};
    }
  }
  request.fit = arguments.fit;
  request.orthographic = arguments.orthographic;
  request.aspect = aspect;
  return request;
}

}  // namespace tenon
