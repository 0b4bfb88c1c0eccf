#include "tenon/image/tone_map.h"

#include <algorithm>
#include <cmath>

namespace tenon {

namespace {

// Squares of what is brighter would leave the range of a double; the curves have reached their limits long before.
constexpr double brightest = 1e150;

double filmic(double x) {
  return x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14);
}

}  // namespace

double luminance(const Rgb& light) {
  return 0.2126 * light.r + 0.7152 * light.g + 0.0722 * light.b;
}

Rgb tone_mapped(const Rgb& light, const ToneMapping& mapping) {
  const double gain = std::exp2(mapping.exposure);
  const auto seen = [gain](double component) { return std::clamp(component * gain, 0.0, brightest); };
  const Rgb exposed{seen(light.r), seen(light.g), seen(light.b)};
  switch (mapping.curve) {
    case ToneCurve::none:
      return exposed;
    case ToneCurve::reinhard:
      return exposed * (1 / (1 + luminance(exposed)));
    case ToneCurve::filmic:
      break;
  }
  return {filmic(exposed.r), filmic(exposed.g), filmic(exposed.b)};
}

}  // namespace tenon
