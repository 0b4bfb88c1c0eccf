#include "scene/choose_camera.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>

#include "scene/camera_frame.h"
#include "tenon/math/affine3.h"

namespace tenon {

namespace {

// A picture that nobody framed has a little air around the solid.
constexpr double with_air = 0.88;
// One that is to be filled keeps silhouettes off its border: 2.5 % are free on each side.
constexpr double filled_up = 0.95;

Vec3 towards(const ViewAngles& angles) {
  const double level = cos_degrees(angles.elevation);
  return {level * cos_degrees(angles.azimuth), level * sin_degrees(angles.azimuth), sin_degrees(angles.elevation)};
}

// From the front right and above; flat things are looked at from higher up, towers from lower down.
ViewAngles usual_angles(const Vec3& size) {
  const double flatness = size.z / std::max({size.x, size.y, std::numeric_limits<double>::min()});
  return {-60, flatness < 0.2 ? 45.0 : flatness > 2 ? 20.0 : 30.0};
}

// The view near the usual one that shows the cut faces best.
ViewAngles angles_to_see(std::span<const SectionCut> cuts, const ViewAngles& usual) {
  ViewAngles best = usual;
  double most = -Box3::inf;
  for (const double elevation : {usual.elevation, 50.0, -30.0}) {
    for (const double turn : {0.0, 30.0, -30.0, 60.0, -60.0, 90.0, -90.0, 120.0, -120.0, 150.0, -150.0, 180.0}) {
      const ViewAngles angles{usual.azimuth + turn, elevation};
      // A face seen at 40 degrees off its normal is seen well enough; what is less usual has to show more.
      double seen = -0.0004 * std::fabs(turn) - 0.002 * std::fabs(elevation - usual.elevation);
      for (const SectionCut& cut : cuts) {
        for (const SectionPlane& plane : cut.planes) {
          seen += std::min(dot(towards(angles), normalize(plane.normal)), cos_degrees(40));
        }
      }
      if (seen > most) {
        most = seen;
        best = angles;
      }
    }
  }
  return best;
}

Camera looking_from(const ViewAngles& angles, Camera camera) {
  camera.up = {0, 0, 1};
  camera.at = {};
  camera.from = towards(angles);
  return camera;
}

// What a solid takes of a perspective picture along one of its axes.
//
// A point p is in the picture of a camera that stands x along the axis and z along `back` when |p·axis - x| is at most
// tangent (z - p·back). Those are two half-spaces, so the solid's supports say where x and z may lie.
template <class Reach>
struct Sides {
  const Reach& reach;
  Vec3 axis, back;

  double upper(double tangent) const { return reach(axis + tangent * back); }
  double lower(double tangent) const { return reach(tangent * back - axis); }

  // How far back the camera has to stand.
  double distance(double tangent) const { return 0.5 * (upper(tangent) + lower(tangent)) / tangent; }

  // Where a camera at that distance has as much of the picture free on one side as on the other: where the solid would
  // just fill a picture of another angle. Each step comes nearer to that angle.
  double middle(double tangent, double distance) const {
    double high = upper(tangent), low = lower(tangent);
    for (int step = 0; step < 4 && high + low > 0; ++step) {
      const double next = 0.5 * (high + low) / distance;
      high = upper(next);
      low = lower(next);
    }
    return 0.5 * (high - low);
  }
};

// The view at the point the camera looks at, with parallel rays.
Camera made_orthographic(Camera camera) {
  if (camera.projection == Projection::orthographic) return camera;
  camera.projection = Projection::orthographic;
  camera.width = 2 * length(camera.at - camera.from) * std::tan(camera.fov * (std::numbers::pi / 360));
  return camera;
}

// The camera without its lens.
Camera choose_place(const ViewRequest& request, const std::optional<Camera>& camera, const CsgTree& tree,
                    std::span<const SectionCut> cuts) {
  const std::optional<Camera>& given = request.camera ? request.camera : camera;
  Camera chosen = given.value_or(Camera{});
  const bool turned = request.angles || !given;
  if (!turned && !request.fit) return request.orthographic ? made_orthographic(chosen) : chosen;

  SolidExtent extent(tree);
  if (request.angles) {
    chosen = looking_from(*request.angles, chosen);
  } else if (!given) {
    const ViewAngles usual = usual_angles(extent.enclosure().is_empty() ? Vec3{} : extent.enclosure().size());
    chosen = looking_from(cuts.empty() ? usual : angles_to_see(cuts, usual), chosen);
  }
  if (request.orthographic) chosen = made_orthographic(chosen);
  return fit_camera(chosen, extent, request.aspect, request.fit ? filled_up : with_air);
}

}  // namespace

Camera choose_camera(const ViewRequest& request, const std::optional<Camera>& camera, const CsgTree& tree,
                     std::span<const SectionCut> cuts) {
  Camera chosen = choose_place(request, camera, tree, cuts);
  if (request.aperture) chosen.aperture = *request.aperture;
  if (request.focus) chosen.focus = request.focus;
  if (request.focus_point) chosen.focus = dot(*request.focus_point - chosen.from, normalize(chosen.at - chosen.from));
  return chosen;
}

Camera fit_camera(const Camera& camera, SolidExtent& extent, double aspect, double filled) {
  const CameraFrame frame = CameraFrame::along(camera.at - camera.from, camera.up);
  const Vec3 back = -frame.forward;
  const bool empty = extent.is_empty();
  const Vec3 middle = extent.enclosure().is_empty() ? Vec3{} : extent.enclosure().center();
  // How far the solid reaches from the middle; a point where nothing is left.
  const auto reach = [&](const Vec3& n) { return empty ? 0 : extent.support(n) - dot(n, middle); };
  const double least = extent.resolution() > 0 ? extent.resolution() : 1;

  Camera fitted = camera;
  double x = 0, y = 0, distance = 0;
  if (camera.projection == Projection::orthographic) {
    const double right = reach(frame.right), left = reach(-frame.right), top = reach(frame.up), low = reach(-frame.up);
    x = 0.5 * (right - left);
    y = 0.5 * (top - low);
    fitted.width = std::max({right + left, (top + low) * aspect, least}) / filled;
    distance = reach(back) + fitted.width;
  } else {
    const double tan_x = filled * std::tan(0.5 * camera.fov * (std::numbers::pi / 180)), tan_y = tan_x / aspect;
    using Across = Sides<std::decay_t<decltype(reach)>>;
    const Across wide{reach, frame.right, back}, tall{reach, frame.up, back};
    distance = std::max({wide.distance(tan_x), tall.distance(tan_y), reach(back) + least});
    x = wide.middle(tan_x, distance);
    y = tall.middle(tan_y, distance);
  }
  fitted.at = middle + x * frame.right + y * frame.up;
  fitted.from = fitted.at + distance * back;
  return fitted;
}

}  // namespace tenon
