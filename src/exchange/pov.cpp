#include "tenon/exchange/pov.h"

#include <algorithm>

#include "exchange/pov_solid.h"
#include "exchange/pov_text.h"
#include "tenon/render/camera_rays.h"
#include "tenon/render/renderer.h"

namespace tenon {

namespace {

void print_globals(const Scene& scene, int depth, PovText& out) {
  out << "#version 3.7;\n"
      << "global_settings { assumed_gamma 1 ambient_light rgb 1 max_trace_level " << static_cast<double>(depth)
      << " adc_bailout " << invisible_share(8) << " }\n"
      << "background { " << scene.background << " }\n";
}

// All three axes are given, so POV-Ray's left-handed habit does not come in.
void print_camera(const ScreenView& view, PovText& out) {
  const Vec3 width = 2 * view.half_width * view.right, height = 2 * view.half_width * view.up;
  out << "camera { " << (view.orthographic ? "orthographic" : "perspective") << " location " << view.eye << " right "
      << width << " up image_height / image_width * " << height << " direction " << view.forward << " }\n";
}

// A distance that is far for everything in the scene.
double far_away(const Scene& scene) {
  const Box3 bounds = scene_figures(scene).bounds;
  constexpr double unbounded = 1e6;
  return bounds.is_bounded() ? 4 * (bounds.largest_coordinate() + length(bounds.size())) : unbounded;
}

void print_light(const Light& light, double far, PovText& out) {
  const Vec3 direction = normalize(light.direction);
  const Rgb emitted = light.intensity * linear_from_srgb(light.color);
  const bool directional = light.kind == LightKind::directional;
  out << "light_source { " << (directional ? -far * direction : light.position) << ", " << emitted;
  if (directional) out << " parallel point_at " << Vec3{};
  if (light.kind == LightKind::spot) {
    out << " spotlight point_at " << light.position + direction << " radius " << light.angle * (1 - light.softness)
        << " falloff " << light.angle << " tightness 0";
  }
  out << " }\n";
}

// Of a transparent pigment POV-Ray takes the diffuse and the ambient term by what it does not transmit; kd has that
// share taken off already. Of one that transmits all it takes nothing, whatever stands here.
void print_material(const std::string& name, const Material& m, const Rgb& ambient, PovText& out) {
  const bool whitted = m.model == MaterialModel::whitted;
  const double transmitted = whitted ? m.kt : 0;
  const double opaque = transmitted < 1 ? 1 - transmitted : 1;
  const Rgb color = linear_from_srgb(m.color.value_or(Rgba{1, 1, 1, 1}));
  out << "#declare " << name << " = material { texture { pigment { " << color;
  if (transmitted > 0) out << " transmit " << transmitted;
  out << " } finish { ambient " << m.ka.value_or(m.kd) / opaque * ambient << " diffuse " << m.kd / opaque;
  if (m.ks > 0 && m.shininess > 0) out << " specular " << m.ks << " roughness " << 1 / m.shininess;
  if (whitted && m.ks > 0) out << " reflection { " << m.ks << " }";
  out << " } }";
  if (transmitted > 0) out << " interior { ior " << m.ior << " }";
  out << " }\n";
}

// What POV-Ray's finish and light_source say nothing like.
Status check_expressible(const Scene& scene) {
  for (const Material& m : scene.materials) {
    const bool course = m.model == MaterialModel::whitted || m.model == MaterialModel::phong;
    if (course && m.texture.kind == TextureKind::none && m.emission == 0 && m.attenuation_color == Rgba{1, 1, 1, 1}) {
      continue;
    }
    return Error{ErrorKind::input,
                 "a POV-Ray scene is written with the materials \"whitted\" and \"phong\" alone, in one colour, and "
                 "the scene has another" +
                     (m.name.empty() ? std::string() : ", '" + m.name + "'"),
                 {}};
  }
  for (const Light& light : scene.lights) {
    const bool course =
        light.kind == LightKind::point || light.kind == LightKind::directional || light.kind == LightKind::spot;
    if (course && light.fade_distance == 0) continue;
    return Error{ErrorKind::input,
                 "a POV-Ray scene is written with point, directional and spot lights alone that do not fade, and the "
                 "scene has another",
                 {}};
  }
  return success();
}

}  // namespace

Result<std::string> print_pov(const Scene& scene, int depth) {
  // The rays do not depend on the height, and on the width only by their number.
  const Result<CameraRays> camera = CameraRays::create(scene.camera, 1, 1);
  if (!camera) return camera.error();
  if (Status status = check_expressible(scene); !status) return status.error();
  PovText out;
  print_globals(scene, depth, out);
  print_camera(camera->view(), out);
  const double far = far_away(scene);
  for (const Light& light : scene.lights) print_light(light, far, out);
  print_material(pov_material_name({}), scene.default_material, scene.ambient, out);
  for (std::size_t i = 0; i < scene.materials.size(); ++i) {
    print_material(pov_material_name(MaterialId{i}), scene.materials[i], scene.ambient, out);
  }
  if (Status status = print_pov_solid(scene, out); !status) return status.error();
  return out.take();
}

}  // namespace tenon
