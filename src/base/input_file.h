#pragma once

#include <string>

#include "tenon/base/error.h"

namespace tenon {

/// A file that has been read.
struct InputFile {
  std::string path;  ///< as messages show it
  std::string bytes;
};

/// An error about a file as a whole.
Error at_file(const std::string& path, const std::string& message, ErrorKind kind = ErrorKind::input);

/// Reads a file of at most 4 GiB.
/// @param kind  what it should be, for messages: "a mesh file"
/// @return an error of kind input where there is no such file, or of kind machine where it cannot be read
Result<InputFile> read_input_file(const std::string& path, const std::string& kind);

/// The ending of a file's name in small letters, with its dot: ".stl"; empty where it has none.
std::string ending_of(const std::string& path);

}  // namespace tenon
