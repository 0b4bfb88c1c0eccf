#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tenon/base/error.h"
#include "tenon/film/film.h"
#include "tenon/image/picture.h"

namespace tenon {

/// Samples [first, end) of every pixel of a window.
struct SampleBox {
  PixelWindow window;
  std::uint32_t first = 0, end = 0;

  std::uint64_t samples() const { return window.pixels() * static_cast<std::uint64_t>(end - first); }
  friend bool operator==(const SampleBox&, const SampleBox&) = default;
};

/// A film, and which part of which picture it holds: what a checkpoint keeps, and what pictures are merged from. Where
/// sampling is adaptive a sample counts as done once it is known that the pixel does without.
struct FilmPart {
  Film film;
  Layers layers;                   ///< that the picture is to show
  bool transparent = false;        ///< the background is left out
  int bits = 16;                   ///< of its components, see film_picture()
  std::uint32_t samples = 1;       ///< of each pixel, when the picture is complete
  std::vector<SampleBox> done;     ///< disjoint
  std::vector<PictureNote> notes;  ///< what the picture follows from; parts of one picture have the same

  bool is_complete() const;
  /// The share of the picture's samples that are done, 0 to 1.
  double share() const;
};

/// Boxes joined where they make a larger box; in the same order whatever order they come in.
std::vector<SampleBox> joined(std::vector<SampleBox> boxes);

/// How many samples a pixel has, on average, and how many it was to have at most: "64 a pixel", or "12.5 of 65536 a
/// pixel" where time was over, there was little noise left, or only a part was asked for.
PictureNote samples_note(const FilmPart& part);

/// The picture of a part, with its notes and samples_note(). A part that is not complete, or has Layer::sums, carries
/// its exact sums.
Picture part_picture(const FilmPart& part);

/// Reads a part back.
/// @param name  stands for the file in messages
/// @return the part, or an input error: a picture without sums
Result<FilmPart> read_part(const Picture& picture, const std::string& name);

/// What makes two parts belong to different pictures, in words; empty when nothing does.
std::string picture_difference(const FilmPart& a, const FilmPart& b);

/// The part of a part that lies in a window.
FilmPart cropped(const FilmPart& part, const PixelWindow& window);

/// Adds parts of one picture up: in any order, to the same bytes as when it is taken in one go.
/// @param names  of the parts, for messages
/// @return the part that they make, or an input error: parts of different pictures, or the same samples twice
Result<FilmPart> merge(const std::vector<FilmPart>& parts, const std::vector<std::string>& names);

}  // namespace tenon
