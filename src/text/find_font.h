#pragma once

#include <string>

#include "tenon/base/error.h"

namespace tenon {

/// A font file of this machine.
struct FontFile {
  std::string path;
  int index = 0;       ///< of the face within the file
  std::string family;  ///< the face's own names
  std::string style;
  bool is_asked_for = true;  ///< false where another family stands in for one that is not installed
};

/// Has find_font() know the fonts of a file, too, from now on.
/// @return an error (without place) where fontconfig finds none in it
Status add_font_file(const std::string& path);

/// The installed font that comes nearest to a pattern, by fontconfig.
/// @param pattern  as fontconfig has it: "Liberation Sans:style=Bold"
/// @return an error of kind machine (without place) where no font is installed
Result<FontFile> find_font(const std::string& pattern);

}  // namespace tenon
