#pragma once

#include <cstdint>
#include <limits>

#include "tenon/film/film_planes.h"
#include "tenon/film/layers.h"
#include "tenon/image/picture.h"
#include "tenon/math/color.h"
#include "tenon/math/vec3.h"

namespace tenon {

/// What is seen, by numbers from 1; 0: nothing is.
struct SurfaceIds {
  std::uint32_t primitive = 0, material = 0, solid = 0;
};

/// What one ray of the camera brings to its pixel.
struct FilmSample {
  std::uint32_t index = 0;  ///< which sample of the pixel it is
  Rgb light;                ///< weighted with alpha
  double alpha = 1;         ///< 0: the pixel lets what is behind the picture through

  double depth = std::numeric_limits<double>::infinity();  ///< distance to what is seen
  Vec3 normal, point;
  Rgb albedo;
  SurfaceIds ids;

  std::uint32_t crossings = 0;  ///< boundaries of the solid along the whole ray
  double path_length = 0;       ///< inside the solid, along the whole ray
};

/// The picture while it is taken, or a part of it: for each pixel of a window the sums of its samples. They are exact
/// (ExactSum), so films of other samples and other windows add up to the same bytes in any order.
/// Threads may add to different pixels at once.
class Film {
 public:
  Film() = default;
  /// @param width, height  of the whole picture
  /// @param window         the part of it that is kept
  /// @param layers         what is kept beside the colour
  Film(int width, int height, const PixelWindow& window, const Layers& layers);
  /// A film from its planes, which have the sizes that window and layers ask for.
  Film(int width, int height, const PixelWindow& window, const Layers& layers, FilmPlanes planes);

  int width() const { return width_; }
  int height() const { return height_; }
  const PixelWindow& window() const { return window_; }
  const Layers& layers() const { return layers_; }
  const FilmPlanes& planes() const { return planes_; }

  void add(int x, int y, const FilmSample& sample);
  /// Adds the samples of another film of the same picture, with the same layers, where the windows overlap.
  void add(const Film& part);
  /// The part of the film in a window; pixels that it does not have are there without samples.
  Film cropped(const PixelWindow& window) const;

  /// How many samples a pixel has.
  std::uint32_t samples(int x, int y) const { return planes_.samples[window_.index(x, y)]; }
  /// Means over a pixel's samples; 0 where it has none.
  Rgb light(int x, int y) const;
  double alpha(int x, int y) const;
  /// The squared standard error of light(); 0 where there are fewer than two samples. Needs Layer::variance.
  Rgb variance(int x, int y) const;

  /// What a film of that size takes.
  static double bytes(const PixelWindow& window, const Layers& layers);

 private:
  int width_ = 0, height_ = 0;
  PixelWindow window_;
  Layers layers_;
  FilmPlanes planes_;
};

/// Whether a film with these layers keeps what its pixels' first samples met.
inline bool keeps_first(const Layers& layers) {
  return layers.has(Layer::depth) || layers.has(Layer::point) || layers.has(Layer::ids);
}

}  // namespace tenon
