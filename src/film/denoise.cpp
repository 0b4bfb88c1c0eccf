#include "tenon/film/denoise.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include "tenon/base/parallel_for.h"
#include "tenon/math/color.h"
#include "tenon/math/vec3.h"

namespace tenon {

namespace {

// Schied et al. 2017, §4.4: how fast the weights fall with depth and with the difference of light.
constexpr double sigma_depth = 1, sigma_light = 4;

// How fast they fall with the squared difference of normals and of albedo: to a third at 6° and at 0.07.
constexpr double normal_scale = 0.01, albedo_scale = 0.005;

// What is divided by less would be noise alone.
constexpr double least_albedo = 0.01;

// Pixels to each side over which errors are averaged: of the picture, and of the filter, which differ more from place
// to place.
constexpr int noise_reach = 3, bias_reach = 2;

// The B3 spline that the wavelet's scaling function is (Dammertz et al. 2010, §3).
constexpr std::array<double, 3> kernel{3.0 / 8, 1.0 / 4, 1.0 / 16};

Vec3 difference(const Rgb& a, const Rgb& b) {
  return {a.r - b.r, a.g - b.g, a.b - b.b};
}

double squared_difference(const Rgb& a, const Rgb& b) {
  return dot(difference(a, b), difference(a, b));
}

double squared_difference(const Vec3& a, const Vec3& b) {
  return dot(a - b, a - b);
}

/// Light without albedo.
struct Lit {
  Rgb light;
  double variance = 0;  ///< of its components together
  double own = 1;       ///< how much it follows the noise of the pixel itself, from 0 to 1
};

/// What tells pixels apart, and does not change.
struct Guide {
  Vec3 normal;  ///< the mean: shorter where the pixel has an edge
  Rgb albedo;
  double spread = 0;  ///< the variance that a share of the pixel may have
  double depth = 0;
  double slope_x = 0, slope_y = 0;  ///< of the depth, per pixel
};

/// Filters one picture.
class Denoiser {
 public:
  Denoiser(const Picture& picture, int threads)
      : picture_(picture), width_(picture.window.width()), height_(picture.window.height()), threads_(threads) {
    for (const PictureChannel& channel : picture.channels) {
      if (channel.name.rfind("id.", 0) == 0 && channel.type == ChannelType::uint32) ids_.push_back(&channel.numbers);
    }
    make_guides();
    make_light();
  }

  void run(const std::function<void()>& row_done) {
    noisy_ = lit_;
    std::vector<Lit> next(lit_.size());
    for (int level = 0; level < denoise_levels; ++level) {
      smooth_variance();
      for_each_row([&](int y) {
        for (int x = 0; x < width_; ++x) next[index(x, y)] = filtered(x, y, 1 << level);
        if (row_done) row_done();
      });
      lit_.swap(next);
    }
    weigh_against_noisy();
  }

  Rgb colour(std::size_t i) const { return divisors_[i] * lit_[i].light; }

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
  template <class Body>
  void for_each_row(const Body& body) const {
    parallel_for(static_cast<std::size_t>(height_), threads_, [&](std::size_t y, int) { body(static_cast<int>(y)); });
  }

  void make_guides() {
    const auto normal = three("N.X", "N.Y", "N.Z"), albedo = three("albedo.R", "albedo.G", "albedo.B");
    const std::vector<float>& depth = picture_.find("Z")->values;
    const std::vector<std::uint32_t>& samples = picture_.find("samples")->numbers;
    guides_.resize(picture_.window.pixels());
    for (std::size_t i = 0; i < guides_.size(); ++i) {
      guides_[i].normal = {(*normal[0])[i], (*normal[1])[i], (*normal[2])[i]};
      guides_[i].albedo = {(*albedo[0])[i], (*albedo[1])[i], (*albedo[2])[i]};
      // A sample that shows the one thing or the other has a variance of 1/4 at most.
      guides_[i].spread = 0.25 / std::max(samples[i], 1U);
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

  void make_light() {
    const auto colour = three("R", "G", "B"), variance = three("variance.R", "variance.G", "variance.B"),
               error = three("error.R", "error.G", "error.B");
    const std::size_t pixels = picture_.window.pixels();
    divisors_.resize(pixels);
    lit_.resize(pixels);
    std::vector<double> squared_errors(pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
      // The mean normal is as long as the share of the pixel that surfaces fill; the rest, the background, is light
      // that no albedo has dimmed.
      const double background = std::max(0.0, 1 - length(guides_[i].normal));
      const auto divisor = [&](double albedo) { return std::max(least_albedo, albedo + background); };
      const Rgb& albedo = guides_[i].albedo;
      divisors_[i] = {divisor(albedo.r), divisor(albedo.g), divisor(albedo.b)};
      const std::array<double, 3> divided{divisors_[i].r, divisors_[i].g, divisors_[i].b};
      std::array<double, 3> light{};
      for (std::size_t c = 0; c < 3; ++c) {
        light[c] = double{(*colour[c])[i]} / divided[c];
        lit_[i].variance += std::max(0.0, double{(*variance[c])[i]}) / (divided[c] * divided[c]);
        squared_errors[i] += std::pow(double{(*error[c])[i]} / divided[c], 2);
      }
      lit_[i].light = {light[0], light[1], light[2]};
    }
    correct_variance(squared_errors);
  }

  // Evenly spread samples err less than independent ones would, whose variance is known of each pixel; how much less,
  // the halves of the samples tell of some pixels together (Rousselle, Knaus, Zwicker 2012, §5.1).
  void correct_variance(const std::vector<double>& squared_errors) {
    std::vector<double> corrected(lit_.size());
    for_each_row([&](int y) {
      for (int x = 0; x < width_; ++x) {
        double variance = 0, error = 0;
        for_each_alike(x, y, noise_reach, [&](std::size_t there) {
          variance += lit_[there].variance;
          error += squared_errors[there];
        });
        const std::size_t at = index(x, y);
        corrected[at] = lit_[at].variance * (error < variance ? error / variance : 1);
      }
    });
    for (std::size_t i = 0; i < lit_.size(); ++i) lit_[i].variance = corrected[i];
  }

  // The standard error that light is compared with, of a few pixels: one pixel's own is a guess (§4.4).
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
    Lit sum;
    double own_weight = 0, weights = 0;
    // How the weights change with the pixel's own light: the nearer it is to what it is compared with, the more that
    // weighs. What they make of the sum is the second term of the estimator's divergence in Stein 1981.
    Vec3 slope;
    double slope_of_sum = 0;
    for (int dy = -2; dy <= 2; ++dy) {
      for (int dx = -2; dx <= 2; ++dx) {
        const int qx = x + dx * step, qy = y + dy * step;
        if (!is_inside(qx, qy)) continue;
        const std::size_t there = index(qx, qy);
        double weight = kernel[static_cast<std::size_t>(std::abs(dx))] * kernel[static_cast<std::size_t>(std::abs(dy))];
        if (there == at) {
          own_weight = weight;
        } else {
          weight *= likeness(at, there, std::abs(dx) * step, std::abs(dy) * step);
          const Vec3 away = difference(lit_[at].light, lit_[there].light);
          if (const double distance = length(away); weight > 0 && distance > 0) {
            const Vec3 falling = (weight / (distance * sigma_light * smooth_error_[at])) * away;
            slope = slope + falling;
            slope_of_sum += dot(falling, difference(lit_[there].light, {}));
          }
        }
        sum.light += weight * lit_[there].light;
        sum.variance += weight * weight * lit_[there].variance;
        weights += weight;
      }
    }
    const Rgb light = sum.light * (1 / weights);
    const double followed = (own_weight + dot(slope, difference(light, {})) - slope_of_sum) / weights;
    return {light, sum.variance / (weights * weights), lit_[at].own * std::clamp(followed, 0.0, 1.0)};
  }

  // Where the filter changes more than the noise there was, it takes the picture itself away: detail that no layer
  // tells of, such as what glass shows. Of all sums of the noisy pixel and a share of the change, that one errs least
  // which takes the share that the covariance of change and noise has of the squared change (Stein 1981; both are means
  // over pixels around); the change holds the noise but for what the filter follows of it. Such a sum errs no more
  // than the noisy pixel unless the variance is taken for more than twice what it is. A change of its own beyond three
  // standard errors is no noise either.
  void weigh_against_noisy() {
    const std::vector<Lit> smooth = lit_;
    const auto squared_change = [&](std::size_t i) { return squared_difference(noisy_[i].light, smooth[i].light); };
    for_each_row([&](int y) {
      for (int x = 0; x < width_; ++x) {
        const std::size_t at = index(x, y);
        double change = 0, noise = 0, covariance = 0, pixels = 0;
        for_each_alike(x, y, bias_reach, [&](std::size_t there) {
          change += squared_change(there);
          noise += noisy_[there].variance;
          covariance += (1 - smooth[there].own) * noisy_[there].variance;
          ++pixels;
        });
        const double others = 1 - smooth[at].own, own_change = squared_change(at);
        const double own_noise = others * others * std::max(noisy_[at].variance, noise / pixels);
        if (!(change > covariance) && !(own_change > 9 * own_noise)) continue;
        const double share = std::min(covariance / change, 9 * own_noise / own_change);
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
  double likeness(std::size_t at, std::size_t there, int dx, int dy) const {
    if (!same_ids(at, there)) return 0;
    const Guide &a = guides_[at], &b = guides_[there];
    // Means without edges are worth their own noise less, which is that of both pixels.
    const double spread = a.spread + b.spread;
    double exponent = squared_difference(a.normal, b.normal) / (normal_scale + spread) +
                      squared_difference(a.albedo, b.albedo) / (albedo_scale + spread);
    if (a.depth != b.depth) {
      // A pixel's first sample is no better than a pixel of slope more; and depths are sums of single precision, a few
      // roundings of which say nothing.
      constexpr double depth_rounding = 8 * std::numeric_limits<float>::epsilon();
      const double slope =
          sigma_depth * (a.slope_x * (dx + 1) + a.slope_y * (dy + 1)) + depth_rounding * std::fabs(a.depth);
      exponent += std::fabs(a.depth - b.depth) / slope;
    }
    const double difference = squared_difference(lit_[at].light, lit_[there].light);
    if (difference > 0) {
      if (smooth_error_[at] == 0) return 0;
      exponent += std::sqrt(difference) / (sigma_light * smooth_error_[at]);
    }
    return std::isfinite(exponent) ? std::exp(-exponent) : 0;
  }

  const Picture& picture_;
  int width_, height_, threads_;
  std::vector<const std::vector<std::uint32_t>*> ids_;
  std::vector<Rgb> divisors_;
  std::vector<Lit> lit_, noisy_;
  std::vector<Guide> guides_;
  std::vector<double> smooth_error_;
};

}  // namespace

Layers denoise_layers() {
  return Layers{Layer::depth, Layer::normal, Layer::albedo, Layer::ids, Layer::samples, Layer::variance};
}

Status denoise(Picture& picture, const std::string& name, const DenoiseOptions& options) {
  for (const char* needed : {"R", "G", "B", "Z", "N.X", "N.Y", "N.Z", "albedo.R", "albedo.G", "albedo.B", "samples",
                             "variance.R", "variance.G", "variance.B", "error.R", "error.G", "error.B"}) {
    const PictureChannel* channel = picture.find(needed);
    const bool is_number = std::string_view(needed) == "samples";
    if (channel != nullptr && (channel->type == ChannelType::uint32) == is_number) continue;
    return Error{ErrorKind::input,
                 "'" + name + "' has no channel " + needed + ", which denoising goes by; render it with --layers " +
                     layers_text(denoise_layers()),
                 {}};
  }
  const std::vector<std::uint32_t>& samples = picture.find("samples")->numbers;
  if (std::none_of(samples.begin(), samples.end(), [](std::uint32_t taken) { return taken > 1; })) {
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
  Denoiser denoiser(picture, options.threads);
  denoiser.run(options.row_done);
  for (std::size_t i = 0; i < picture.window.pixels(); ++i) {
    const Rgb light = denoiser.colour(i);
    colour[0]->values[i] = static_cast<float>(light.r);
    colour[1]->values[i] = static_cast<float>(light.g);
    colour[2]->values[i] = static_cast<float>(light.b);
  }
  return success();
}

}  // namespace tenon
