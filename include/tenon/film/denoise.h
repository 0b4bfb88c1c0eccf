#pragma once

#include <functional>
#include <string>

#include "tenon/base/error.h"
#include "tenon/film/layers.h"
#include "tenon/image/picture.h"

namespace tenon {

struct DenoiseOptions {
  int threads = 1;
  std::function<void()> row_done = nullptr;  ///< called denoise_levels times for each row of the picture, by any thread
};

/// How often the picture is filtered, each time with taps twice as far apart: 1, 2, 4, 8 and 16 pixels.
inline constexpr int denoise_levels = 5;

/// The layers it goes by.
Layers denoise_layers();

/// Takes the noise out of a picture's colour by means over pixels that show the same: the edge-avoiding à-trous wavelet
/// filter (Dammertz, Sewtz, Hanika, Lensch 2010), which stops at edges of normal, albedo, depth and light, the last by
/// the standard error that is left (as in spatiotemporal variance-guided filtering, Schied et al. 2017, §4.3 and 4.4).
/// The picture's error is known from halves of its samples; where the filter changes more than that, as much of the
/// noisy picture stays as makes the expected error least. Light is filtered without albedo, so that textures stay;
/// pixels whose ids differ are never mixed. The same bytes come of any number of threads.
/// @param picture  with the channels of denoise_layers(); its R, G and B are replaced
/// @param name     stands for the picture in messages
/// @return success, or an input error: what the picture lacks
Status denoise(Picture& picture, const std::string& name, const DenoiseOptions& options);

}  // namespace tenon
