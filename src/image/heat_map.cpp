#include "tenon/image/heat_map.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>

#include "image/text.h"
#include "image/viridis.h"
#include "tenon/math/color.h"

namespace tenon {

namespace {

constexpr int margin = 8, bar_height = 14, tick_height = 4;
constexpr int least_width = 320;

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, value >= 1e6 ? "%.3g" : "%.4g", value);
  return text;
}

/// Where a value lies between the first and the last colour.
class ColorScale {
 public:
  explicit ColorScale(const HeatMap& map) {
    std::vector<double> sorted(map.values.begin(), map.values.end());
    std::sort(sorted.begin(), sorted.end());
    if (!sorted.empty()) last_ = sorted.back();
    const auto positive = std::upper_bound(sorted.begin(), sorted.end(), 0.0);
    const double least = positive == sorted.end() ? 0 : *positive;
    // A scale that is given is to be the same whatever the values are.
    const bool steep = !sorted.empty() && last_ > 30 * sorted[sorted.size() / 2];
    logarithmic_ = map.scale == HeatScale::logarithmic || (map.scale == HeatScale::automatic && steep);
    if (map.largest > 0) last_ = map.largest;
    if (!(last_ > 0)) last_ = 1;
    if (logarithmic_) first_ = map.largest > 0 || !(least > 0) ? std::min(1.0, three_decades * last_) : least;
    if (logarithmic_ && !(first_ < last_)) first_ = last_ / 10;
  }

  bool logarithmic() const { return logarithmic_; }
  double last() const { return last_; }

  double place(double value) const {
    if (!logarithmic_) return value / last_;
    return value > first_ ? std::log(value / first_) / std::log(last_ / first_) : 0;
  }

  /// The round numbers to write beside the colours.
  std::vector<double> ticks() const { return logarithmic_ ? logarithmic_ticks() : linear_ticks(); }

 private:
  static constexpr double three_decades = 1e-3;
  // Of a power of ten and its products: a dozen roundings.
  static constexpr double rounding = 12 * std::numeric_limits<double>::epsilon();

  std::vector<double> linear_ticks() const {
    const double power = std::pow(10, std::floor(std::log10(last_)));
    double step = power;
    for (const double part : {0.5, 0.2, 0.1}) {
      if (last_ / step < 4) step = part * power;
    }
    std::vector<double> ticks;
    for (int i = 0; i * step <= last_ * (1 + rounding); ++i) ticks.push_back(i * step);
    return ticks;
  }

  // Powers of ten; 2 and 5 of each where there are few.
  std::vector<double> logarithmic_ticks() const {
    const double decades = std::log10(last_ / first_);
    std::vector<double> ticks;
    for (double power = std::pow(10, std::floor(std::log10(first_))); power <= last_; power *= 10) {
      for (const double digit : {1.0, 2.0, 5.0}) {
        if (digit != 1 && decades > 2) continue;
        const double tick = digit * power;
        if (tick >= first_ * (1 - rounding) && tick <= last_ * (1 + rounding)) ticks.push_back(tick);
      }
    }
    return ticks;
  }

  bool logarithmic_ = false;
  double first_ = 0, last_ = 1;
};

Rgb color_at(double place) {
  const double i = std::clamp(place, 0.0, 1.0) * static_cast<double>(viridis.size() - 1);
  const std::uint32_t c = viridis[static_cast<std::size_t>(std::lround(i))];
  return linear_from_srgb({(c >> 16 & 255) / 255.0, (c >> 8 & 255) / 255.0, (c & 255) / 255.0, 1});
}

class Canvas {
 public:
  Canvas(int width, int height) : picture_{width, height, {}} {
    picture_.rgb.assign(3 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 1.0F);
  }

  void set(int x, int y, const Rgb& color) {
    if (x < 0 || y < 0 || x >= picture_.width || y >= picture_.height) return;
    const std::size_t i =
        3 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(picture_.width) + static_cast<std::size_t>(x));
    picture_.rgb[i] = static_cast<float>(color.r);
    picture_.rgb[i + 1] = static_cast<float>(color.g);
    picture_.rgb[i + 2] = static_cast<float>(color.b);
  }
  void write(const std::string& text, int x, int y, int scale) {
    for (const TextBar& bar : draw_text(text, x, y, scale)) {
      for (int row = bar.y0; row < bar.y1; ++row) {
        for (int column = bar.x0; column < bar.x1; ++column) set(column, row, {});
      }
    }
  }
  HeatMapPicture finish() { return std::move(picture_); }

 private:
  HeatMapPicture picture_;
};

// Numbers that would run into the one before are left out.
void draw_legend(const HeatMap& map, const ColorScale& scale, int width, int scale_of_text, Canvas& canvas) {
  const int left = margin, length = width - 2 * margin;
  int y = map.height + margin;
  for (int x = 0; x < length; ++x) {
    const Rgb color = color_at(static_cast<double>(x) / (length - 1));
    for (int row = 0; row < bar_height; ++row) canvas.set(left + x, y + row, color);
  }
  y += bar_height;
  int free_from = 0;
  for (const double tick : scale.ticks()) {
    const int x = left + static_cast<int>(std::lround(scale.place(tick) * (length - 1)));
    for (int row = 0; row < tick_height; ++row) canvas.set(x, y + row, {});
    const std::string text = number(tick);
    const int text_length = text_width(text, scale_of_text);
    const int begin = std::clamp(x - text_length / 2, 0, width - text_length);
    if (begin < free_from) continue;
    canvas.write(text, begin, y + tick_height + 2, scale_of_text);
    free_from = begin + text_length + 6 * scale_of_text;
  }
  y += tick_height + 2 + text_height(scale_of_text);
  canvas.write(map.title, left, y, scale_of_text);
  const double most = map.values.empty() ? 0 : *std::max_element(map.values.begin(), map.values.end());
  double sum = 0;
  for (const double v : map.values) sum += v;
  const double mean = map.values.empty() ? 0 : sum / static_cast<double>(map.values.size());
  const std::string facts = std::string(scale.logarithmic() ? "logarithmic" : "linear") + " scale; mean " +
                            number(mean) + ", most " + number(most);
  canvas.write(facts, left, y + text_height(scale_of_text), scale_of_text);
}

}  // namespace

HeatMapPicture draw_heat_map(const HeatMap& map) {
  const ColorScale scale(map);
  const int width = std::max(map.width, least_width);
  const int scale_of_text = width >= 2 * least_width ? 2 : 1;
  const int legend = margin + bar_height + tick_height + 2 + 3 * text_height(scale_of_text) + margin;
  Canvas canvas(width, map.height + legend);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const std::size_t i =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(map.width) + static_cast<std::size_t>(x);
      canvas.set(x, y, color_at(scale.place(map.values[i])));
    }
  }
  draw_legend(map, scale, width, scale_of_text, canvas);
  return canvas.finish();
}

}  // namespace tenon
