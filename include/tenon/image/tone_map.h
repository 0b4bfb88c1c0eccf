#pragma once

#include <array>
#include <string_view>

#include "tenon/math/color.h"

namespace tenon {

/// How light beyond what a display shows is brought into its range.
enum class ToneCurve {
  none,      ///< it is clamped
  reinhard,  ///< L / (1 + L) on the luminance L; Reinhard, Stark, Shirley, Ferwerda 2002, equation 3
  filmic,    ///< (x (2.51 x + 0.03)) / (x (2.43 x + 0.59) + 0.14) on each component: Narkowicz's fit (2015) of ACES
};

inline constexpr std::array<std::string_view, 3> tone_curve_names{"none", "reinhard", "filmic"};

struct ToneMapping {
  ToneCurve curve = ToneCurve::none;
  double exposure = 0;  ///< stops: light is multiplied by 2^exposure first
};

/// The luminance of linear light (ITU-R BT.709).
double luminance(const Rgb& light);

/// Light as a display is to show it; components below 0 become 0.
Rgb tone_mapped(const Rgb& light, const ToneMapping& mapping);

}  // namespace tenon
