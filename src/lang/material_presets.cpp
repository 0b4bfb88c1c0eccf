#include "lang/material_presets.h"

namespace tenon::lang {

namespace {

Material glossy(double kd, double ks, double kt, double shininess, double ior, std::optional<Rgba> color) {
  Material m;
  m.model = MaterialModel::whitted;
  m.kd = kd;
  m.ks = ks;
  m.kt = kt;
  m.shininess = shininess;
  m.ior = ior;
  m.color = color;
  return m;
}

}  // namespace

Material material_preset(std::string_view name) {
  if (name == "glass") return glossy(0.05, 0.1, 0.85, 200, 1.5, Rgba{1, 1, 1, 1});
  if (name == "water") return glossy(0.05, 0.1, 0.85, 200, 1.33, Rgba{0.9, 0.97, 1, 1});
  if (name == "mirror") return glossy(0.05, 0.95, 0, 400, 1, Rgba{1, 1, 1, 1});
  if (name == "chrome") return glossy(0.25, 0.75, 0, 200, 1, Rgba{0.8, 0.8, 0.82, 1});
  if (name == "gold") return glossy(0.5, 0.5, 0, 100, 1, Rgba{1, 0.78, 0.34, 1});
  if (name == "silver") return glossy(0.5, 0.5, 0, 100, 1, Rgba{0.91, 0.92, 0.93, 1});
  if (name == "copper") return glossy(0.5, 0.5, 0, 100, 1, Rgba{0.93, 0.62, 0.52, 1});
  Material m;
  if (name == "plastic") {
    m.kd = 0.7;
    m.ks = 0.3;
    m.shininess = 60;
  } else if (name == "matte") {
    m.kd = 1;
    m.ks = 0;
  }
  return m;
}

}  // namespace tenon::lang
