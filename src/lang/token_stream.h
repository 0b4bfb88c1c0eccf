#pragma once

#include <vector>

#include "lang/lexer.h"
#include "lang/source_files.h"

namespace tenon::lang {

/// The tokens of a file with those of the files it includes in their places.
class TokenStream {
 public:
  /// `after`, where given, goes on where the file ends.
  TokenStream(const SourceText& source, const SourceText* after, SourceFiles& files);

  const Token& peek() const { return next_; }
  Token take();

 private:
  Token read();

  SourceFiles* files_;
  std::vector<Lexer> lexers_;  // the file being read last
  Token next_;
};

/// True for tenon.scad, whose modules are built in; the file itself is for OpenSCAD.
bool is_builtin_library(const std::string& file_name);

}  // namespace tenon::lang
