#pragma once

#include <algorithm>
#include <bit>
#include <cassert>
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
  bool is_in_second_half = false;  ///< see is_in_second_half()

  std::uint32_t crossings = 0;  ///< boundaries of the solid along the whole ray
  double path_length = 0;       ///< inside the solid, along the whole ray
};

/// Which of two halves of a pixel's samples one belongs to: what differs between the halves tells the noise of the
/// whole (Film::error). They are blocks by turns, as long as they can be up to 16: each is as even as low discrepancy
/// makes so many samples, and from two blocks on there is something to compare however many samples there will be.
/// @param samples  of a pixel, when the picture is complete
inline bool is_in_second_half(std::uint32_t index, std::uint32_t samples) {
  constexpr std::uint32_t longest_block = 16;
  const std::uint32_t block = std::min(longest_block, std::bit_floor(std::max(samples / 2, 1U)));
  return (index / block & 1U) != 0;
}

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

  /// Asks the memory for what is kept of some pixels, so that it is there by the time that samples of them are added.
  void fetch(const PixelWindow& pixels) const;
  /// A sample of a film without layers.
  /// @param light  weighted with alpha
  /// @param alpha  0: the pixel lets what is behind the picture through
  void add(int x, int y, const Rgb& light, double alpha) {
    assert(layers_.empty());
    add_light(window_.index(x, y), light, alpha);
  }
  /// A sample of any film.
  void add(int x, int y, const FilmSample& sample);
  /// Adds the samples of another film of the same picture, with the same layers, where the windows overlap.
  void add(const Film& part);
  /// The part of the film in a window; pixels that it does not have are there without samples.
  Film cropped(const PixelWindow& window) const;

  /// How many samples a pixel has.
  std::uint32_t samples(int x, int y) const { return planes_.samples[window_.index(x, y)]; }
  /// The mean of that over all pixels.
  double mean_samples() const;
  /// Means over a pixel's samples; 0 where it has none.
  Rgb light(int x, int y) const;
  double alpha(int x, int y) const;
  /// The squared standard error of light() if samples were independent of each other, more than they err where they are
  /// even; 0 where there are fewer than two samples. Needs Layer::variance.
  Rgb variance(int x, int y) const;
  /// What light() may well err by: half of what differs between the two halves of the samples. Its square is what the
  /// squared error comes to, but for what low discrepancy makes of the halves together; one pixel's alone says little.
  /// The root of variance() where one of the halves is empty. Needs Layer::variance.
  Rgb error(int x, int y) const;

  /// What a film of that size takes.
  static double bytes(const PixelWindow& window, const Layers& layers);

 private:
  void add_light(std::size_t i, const Rgb& light, double alpha);

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
