#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "picture_arguments.h"
#include "scene_arguments.h"
#include "tenon/base/atomic_file.h"
#include "tenon/base/error.h"
#include "tenon/film/film_part.h"

namespace tenon {

/// A file to be written when all is done, or standard output ("-").
class Output {
 public:
  static Result<Output> open(const std::string& path);
  Status finish(std::string_view bytes);

 private:
  std::optional<AtomicFile> file_;
};

/// The bytes of a picture's file.
/// @param transparent  its background is left out
Result<std::string> encode(const Picture& picture, const PicturePlan& plan, bool transparent);

/// The bytes of the file of a picture, or of a part of it, denoised where the plan says so.
Result<std::string> encode(const FilmPart& part, const PicturePlan& plan, int threads, Console& console);

/// Takes the noise out of a picture, and shows how far it is.
/// @param name  stands for the picture in messages
Status denoise(Picture& picture, const std::string& name, int threads, Console& console);

/// A usage error when a picture takes more memory than the machine has.
/// @param size  of the picture, for the message
Status check_memory(double bytes, const std::string& size);

/// Reads an EXR picture; "-" is standard input.
Result<Picture> read_picture(const std::string& path);

/// Size, window and notes of a picture's file, PNG or EXR, that is whole.
Result<Picture> read_head(const std::string& path);

}  // namespace tenon
