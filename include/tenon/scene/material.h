#pragma once

#include <optional>
#include <string>

#include "tenon/math/color.h"

namespace tenon {

enum class MaterialModel {
  whitted,  ///< the course's complete illumination model: diffuse, specular, reflected and refracted light
  phong,    ///< the same local terms without reflected and refracted rays
};

/// How a surface answers to light (Bouatouch's course, "The complete illumination model"). kd + ks + kt should be 1.
struct Material {
  std::string name;
  MaterialModel model = MaterialModel::phong;
  std::optional<double> ka;   ///< share of the ambient light; kd when not given, as in the course
  double kd = 0.8;            ///< diffuse
  double ks = 0.2;            ///< specular, and (whitted) reflected
  double kt = 0;              ///< transmitted
  double shininess = 40;      ///< exponent n of the specular term
  double ior = 1;             ///< index of refraction
  std::optional<Rgba> color;  ///< none: the colour that `color` gives, else the default
  double priority = 0;        ///< where transparent solids overlap the higher priority wins, then the earlier solid

  friend bool operator==(const Material&, const Material&) = default;
};

}  // namespace tenon
