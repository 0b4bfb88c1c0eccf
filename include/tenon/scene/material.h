#pragma once

#include <optional>
#include <string>

#include "tenon/math/color.h"
#include "tenon/scene/texture.h"

namespace tenon {

enum class MaterialModel {
  whitted,     ///< the course's complete illumination model: diffuse, specular, reflected and refracted light
  phong,       ///< the same local terms without reflected and refracted rays
  lambert,     ///< diffuse alone: all light is scattered evenly
  conductor,   ///< a metal: `color` is what it reflects straight on
  dielectric,  ///< glass, water: reflects and refracts by Fresnel; `color` tints what passes
  principled,  ///< layers of these, as in Disney's and Blender's material of that name
};

/// How a surface answers to light, and what fills a transparent solid.
struct Material {
  std::string name;
  MaterialModel model = MaterialModel::phong;

  /// @name Bouatouch's course, "The complete illumination model": whitted and phong. kd + ks + kt should be 1.
  /// @{
  std::optional<double> ka;  ///< share of the ambient light; kd when not given, as in the course
  double kd = 0.8;           ///< diffuse
  double ks = 0.2;           ///< specular, and (whitted) reflected
  double kt = 0;             ///< transmitted
  double shininess = 40;     ///< exponent n of the specular term
  /// @}

  /// @name The microfacet models: conductor, dielectric, principled
  /// @{
  double roughness = 0;       ///< 0: smooth, 1: matt; the square root of GGX's alpha
  double metallic = 0;        ///< principled: 0: a dielectric, 1: a metal
  double transmission = 0;    ///< principled: the share of a dielectric's body that lets light through
  double coat = 0;            ///< principled: of clear varnish (ior 1.5) over all
  double coat_roughness = 0;  ///< principled
  /// @}

  double ior = 1;             ///< index of refraction
  std::optional<Rgba> color;  ///< none: the colour that `color` gives, else the default
  SolidTexture texture;       ///< of `color` and a second one
  double emission = 0;        ///< radiance that the surface sends out, times its colour

  /// What light keeps of itself over `attenuation_distance` inside a transparent solid, by Beer's law.
  Rgba attenuation_color{1, 1, 1, 1};
  double attenuation_distance = 1;

  double priority = 0;  ///< where transparent solids overlap the higher priority wins, then the earlier solid

  /// Whether light passes through a solid of it.
  bool is_transparent() const {
    if (model == MaterialModel::whitted) return kt > 0;
    return model == MaterialModel::dielectric ||
           (model == MaterialModel::principled && transmission > 0 && metallic < 1);
  }

  friend bool operator==(const Material&, const Material&) = default;
};

}  // namespace tenon
