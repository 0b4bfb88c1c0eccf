#pragma once

#include <vector>

#include "tenon/film/film.h"
#include "tenon/image/picture.h"
#include "tenon/image/picture_file.h"
#include "tenon/image/tone_map.h"

namespace tenon {

/// What a film shows: R, G, B (weighted with alpha) and A, and the layers, by the names of layer_names(). Pixels
/// without samples are 0. Layer::sums is left out here (FilmPart).
/// @param bits  16 or 32: of R, G, B, A, N and albedo; what needs 32 bits has them always
Picture film_picture(const Film& film, const Layers& layers, int bits);

/// The pixels that a display gets, of the picture's window.
struct DisplayPixels {
  std::vector<float> rgb;    ///< linear light, not weighted with alpha
  std::vector<float> alpha;  ///< empty: opaque
};

/// @param picture      with the channels R, G and B; alpha comes from A, where it is there
/// @param transparent  the background is left out; otherwise alpha is kept only where some pixel is not there as a
/// whole
DisplayPixels display_pixels(const Picture& picture, const ToneMapping& mapping, bool transparent);

}  // namespace tenon
