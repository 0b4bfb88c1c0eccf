#pragma once

#include <deque>
#include <string>

#include "lang/source_text.h"

namespace tenon::lang {

/// Reads the files of one evaluation and keeps them for messages.
class SourceFiles {
 public:
  /// The text of a file that the caller names; "-" is standard input.
  const SourceText& read(const std::string& path, Place named_at = {});
  /// Text that lies in no file.
  const SourceText& add(std::string name, std::string directory, std::string text);

  /// The path of a file named by `use` or `include` at a place: beside the file that names it, then in the folders of
  /// OPENSCADPATH, then in the user's library folder. Fails when there is none.
  static std::string find(const std::string& name, Place named_at);

 private:
  std::deque<SourceText> texts_;
};

}  // namespace tenon::lang
