#include "tenon/film/denoise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "tenon/base/parallel_for.h"
#include "tenon/image/tone_map.h"
#include "tenon/math/vec3.h"

namespace tenon {

namespace {

// Schied et al. 2017, §4.4: how fast the weights fall with depth, normal and luminance. Their power of the normals'
// cosine is 128, which leaves the noise on balls of few pixels; ids tell here what they ask of normals.
constexpr double sigma_depth = 1, sigma_luminance = 4;
constexpr int normal_squarings = 5;  // the power 32

// What is divided by less would be noise alone.
constexpr double least_albedo = 0.01;

// Pixels to each side over which a bias is looked for: variances of so few samples are worth nothing one by one.
constexpr int bias_reach = 3;

// The B3 spline that the wavelet's scaling function is (Dammertz et al. 2010, §3).
constexpr std::array<double, 3> kernel{3.0 / 8, 1.0 / 4, 1.0 / 16};

/// Light without albedo, and the variance of its luminance.
struct Lit {
  Rgb light;
  double variance = 0;
};

/// What tells pixels apart, and does not change.
struct Guide {
  Vec3 normal;  ///< of length 1, or 0 where nothing is
  double depth = 0;
  double slope_x = 0, slope_y = 0;  ///< of the depth, per pixel
};

/// Filters one picture.
class Denoiser {
 public:
  Denoiser(const Picture& picture, const std::array<const PictureChannel*, 3>& colour)
      : picture_(picture), width_(picture.window.width()), height_(picture.window.height()) {
    for (const PictureChannel& channel : picture.channels) {
      if (channel.name.rfind("id.", 0) == 0 && channel.type == ChannelType::uint32) ids_.push_back(&channel.numbers);
    }
    const auto albedo = three("albedo.R", "albedo.G", "albedo.B");
    const auto normal = three("N.X", "N.Y", "N.Z");
    const auto variance = three("variance.R", "variance.G", "variance.B");
    const std::size_t pixels = picture.window.pixels();
    albedo_.resize(pixels);
    lit_.resize(pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
      // The mean normal is as long as the share of the pixel that surfaces fill; the rest, the background, is light
      // that no albedo has dimmed.
      const Vec3 n{(*normal[0])[i], (*normal[1])[i], (*normal[2])[i]};
      const double background = std::max(0.0, 1 - length(n));
      const auto share = [&](std::size_t c) { return std::max(least_albedo, double{(*albedo[c])[i]} + background); };
      albedo_[i] = {share(0), share(1), share(2)};
      const auto light = [&](std::size_t c) { return double{colour[c]->values[i]} / share(c); };
      const auto error = [&](std::size_t c) { return std::sqrt(std::max(0.0, double{(*variance[c])[i]})) / share(c); };
      lit_[i].light = {light(0), light(1), light(2)};
      // Errors of the three components come from the same paths: they add up.
      const double e = luminance({error(0), error(1), error(2)});
      lit_[i].variance = e * e;
    }
    make_guides();
  }

  void run(const DenoiseOptions& options) {
    noisy_ = lit_;
    std::vector<Lit> next(lit_.size());
    for (int level = 0; level < denoise_levels; ++level) {
      smooth_variance();
      parallel_for(static_cast<std::size_t>(height_), options.threads, [&](std::size_t y, int) {
        for (int x = 0; x < width_; ++x)
          next[index(x, static_cast<int>(y))] = filtered(x, static_cast<int>(y), 1 << level);
        if (options.row_done) options.row_done();
      });
      lit_.swap(next);
    }
    weigh_against_noisy(options);
  }

  Rgb colour(std::size_t i) const { return albedo_[i] * lit_[i].light; }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  bool is_inside(int x, int y) const { return x >= 0 && x < width_ && y >= 0 && y < height_; }
  bool same_ids(std::size_t a, std::size_t b) const {
    return std::all_of(ids_.begin(), ids_.end(), [&](const auto* numbers) { return (*numbers)[a] == (*numbers)[b]; });
  }
  std::array<const std::vector<float>*, 3> three(const char* a, const char* b, const char* c) const {
    return {&picture_.find(a)->values, &picture_.find(b)->values, &picture_.find(c)->values};
  }

  void make_guides() {
    const auto normal = three("N.X", "N.Y", "N.Z");
    const std::vector<float>& depth = picture_.find("Z")->values;
    guides_.resize(lit_.size());
    for (std::size_t i = 0; i < lit_.size(); ++i) {
      const Vec3 n{(*normal[0])[i], (*normal[1])[i], (*normal[2])[i]};
      guides_[i].normal = n == Vec3{} ? n : normalize(n);
      guides_[i].depth = depth[i];
    }
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        guides_[index(x, y)].slope_x = slope(x, y, 1, 0);
        guides_[index(x, y)].slope_y = slope(x, y, 0, 1);
      }
    }
  }

  // The smaller of the differences to both sides: the other may reach over an edge.
  double slope(int x, int y, int dx, int dy) const {
    const std::size_t at = index(x, y);
    double least = std::numeric_limits<double>::infinity();
    for (const int side : {-1, 1}) {
      if (!is_inside(x + side * dx, y + side * dy)) continue;
      const std::size_t there = index(x + side * dx, y + side * dy);
      const double difference = std::fabs(guides_[there].depth - guides_[at].depth);
      if (same_ids(at, there) && difference < least) least = difference;
    }
    return std::isfinite(least) ? least : 0;
  }

  // The standard error that luminances are compared with, of a few pixels: one pixel's own is a guess (§4.4).
  void smooth_variance() {
    smooth_error_.resize(lit_.size());
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        const std::size_t at = index(x, y);
        double sum = 0, weights = 0;
        for (int dy = -1; dy <= 1; ++dy) {
          for (int dx = -1; dx <= 1; ++dx) {
            if (!is_inside(x + dx, y + dy) || !same_ids(at, index(x + dx, y + dy))) continue;
            const double weight = (dx == 0 ? 2 : 1) * (dy == 0 ? 2 : 1);
            sum += weight * lit_[index(x + dx, y + dy)].variance;
            weights += weight;
          }
        }
        smooth_error_[at] = std::sqrt(sum / weights);
      }
    }
  }

  Lit filtered(int x, int y, int step) const {
    const std::size_t at = index(x, y);
    const double here = luminance(lit_[at].light);
    Lit sum;
    double weights = 0;
    for (int dy = -2; dy <= 2; ++dy) {
      for (int dx = -2; dx <= 2; ++dx) {
        const int qx = x + dx * step, qy = y + dy * step;
        if (!is_inside(qx, qy)) continue;
        const std::size_t there = index(qx, qy);
        const double spline =
            kernel[static_cast<std::size_t>(std::abs(dx))] * kernel[static_cast<std::size_t>(std::abs(dy))];
        const double weight =
            there == at ? spline : spline * likeness(at, there, here, std::abs(dx) * step, std::abs(dy) * step);
        sum.light += weight * lit_[there].light;
        sum.variance += weight * weight * lit_[there].variance;
        weights += weight;
      }
    }
    return {sum.light * (1 / weights), sum.variance / (weights * weights)};
  }

  // What the filter takes away beyond the noise there was is the picture itself: detail that no layer tells of, such as
  // what glass shows. The squared differences around a pixel add up to the noise's variance and the square of such a
  // bias; and a difference of its own beyond three standard errors is no noise. Of two estimates, one of a variance and
  // one of a bias, that mean errs least which weighs each by the other's squared error.
  void weigh_against_noisy(const DenoiseOptions& options) {
    const std::vector<Lit> smooth = lit_;
    const auto squared_difference = [&](std::size_t i) {
      const double difference = luminance(noisy_[i].light) - luminance(smooth[i].light);
      return difference * difference;
    };
    parallel_for(static_cast<std::size_t>(height_), options.threads, [&](std::size_t row, int) {
      const int y = static_cast<int>(row);
      for (int x = 0; x < width_; ++x) {
        const std::size_t at = index(x, y);
        double taken = 0, variance = 0, pixels = 0;
        for_each_alike(x, y, bias_reach, [&](std::size_t there) {
          taken += squared_difference(there);
          variance += noisy_[there].variance;
          ++pixels;
        });
        // One pixel's variance may miss what its samples missed, and be all that tells of a stray one.
        const double noise = std::max(noisy_[at].variance, variance / pixels);
        const double bias = std::max((taken - variance) / pixels, squared_difference(at) - 9 * noise);
        if (!(bias > 0)) continue;
        const double share = noise / (noise + bias);
        lit_[at].light = share * smooth[at].light + (1 - share) * noisy_[at].light;
      }
    });
  }

  // Visits the pixels of the same ids up to so many away, itself among them.
  template <class Visit>
  void for_each_alike(int x, int y, int reach, const Visit& visit) const {
    const std::size_t at = index(x, y);
    for (int qy = std::max(0, y - reach); qy <= std::min(height_ - 1, y + reach); ++qy) {
      for (int qx = std::max(0, x - reach); qx <= std::min(width_ - 1, x + reach); ++qx) {
        if (same_ids(at, index(qx, qy))) visit(index(qx, qy));
      }
    }
  }

  // From 0, another thing, to 1, the same.
  double likeness(std::size_t at, std::size_t there, double here, int dx, int dy) const {
    if (!same_ids(at, there)) return 0;
    const Guide &a = guides_[at], &b = guides_[there];
    double facing = std::max(0.0, dot(a.normal, b.normal));
    for (int i = 0; i < normal_squarings; ++i) facing *= facing;
    if (a.normal == Vec3{} && b.normal == Vec3{}) facing = 1;
    if (facing == 0) return 0;

    double exponent = 0;
    if (a.depth != b.depth) {
      // A pixel's first sample is no better than a pixel of slope more; and depths are sums of single precision, a few
      // roundings of which say nothing.
      constexpr double depth_rounding = 8 * std::numeric_limits<float>::epsilon();
      const double slope =
          sigma_depth * (a.slope_x * (dx + 1) + a.slope_y * (dy + 1)) + depth_rounding * std::fabs(a.depth);
      exponent += std::fabs(a.depth - b.depth) / slope;
    }
    const double difference = std::fabs(here - luminance(lit_[there].light));
    if (difference > 0) {
      if (smooth_error_[at] == 0) return 0;
      exponent += difference / (sigma_luminance * smooth_error_[at]);
    }
    return std::isfinite(exponent) ? facing * std::exp(-exponent) : 0;
  }

  const Picture& picture_;
  int width_, height_;
  std::vector<const std::vector<std::uint32_t>*> ids_;
  std::vector<Rgb> albedo_;
  std::vector<Lit> lit_, noisy_;
  std::vector<Guide> guides_;
  std::vector<double> smooth_error_;
};

}  // namespace

Layers denoise_layers() {
  return Layers{Layer::depth, Layer::normal, Layer::albedo, Layer::ids, Layer::variance};
}

Status denoise(Picture& picture, const std::string& name, const DenoiseOptions& options) {
  for (const char* needed : {"R", "G", "B", "Z", "N.X", "N.Y", "N.Z", "albedo.R", "albedo.G", "albedo.B", "variance.R",
                             "variance.G", "variance.B"}) {
    const PictureChannel* channel = picture.find(needed);
    if (channel != nullptr && channel->type != ChannelType::uint32) continue;
    return Error{ErrorKind::input,
                 "'" + name + "' has no channel " + needed + ", which denoising goes by; render it with --layers " +
                     layers_text(denoise_layers()),
                 {}};
  }
  const auto is_known = [](float variance) { return variance > 0; };
  const std::vector<float>& variance = picture.find("variance.G")->values;
  if (std::none_of(variance.begin(), variance.end(), is_known)) {
    return Error{
        ErrorKind::input,
        "nothing is known of the noise in '" + name + "'; render it with --spp 2 at least, or leave it as it is",
        {}};
  }
  std::array<PictureChannel*, 3> colour{};
  for (PictureChannel& channel : picture.channels) {
    if (channel.name == "R") colour[0] = &channel;
    if (channel.name == "G") colour[1] = &channel;
    if (channel.name == "B") colour[2] = &channel;
  }
  Denoiser denoiser(picture, {colour[0], colour[1], colour[2]});
  denoiser.run(options);
  for (std::size_t i = 0; i < picture.window.pixels(); ++i) {
    const Rgb light = denoiser.colour(i);
    colour[0]->values[i] = static_cast<float>(light.r);
    colour[1]->values[i] = static_cast<float>(light.g);
    colour[2]->values[i] = static_cast<float>(light.b);
  }
  return success();
}

}  // namespace tenon
