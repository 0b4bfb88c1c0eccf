#pragma once

#include <vector>

#include "lang/lexer.h"
#include "lang/source_files.h"

namespace tenon::lang {

/// The tokens of a file with those of the files it includes in their places.
class TokenStream {
 public:
  TokenStream(const SourceText& source, SourceFiles& files);

  const Token& peek() const { return next_; }
  Token take();
  /// Goes on with another text where this one ends.
  void append(const SourceText& source) { lexers_.insert(lexers_.begin(), Lexer(source)); }

 private:
  Token read();

  SourceFiles* files_;
  std::vector<Lexer> lexers_;  // the file being read last
  Token next_;
};

/// True for tenon.scad, whose modules are built in; the file itself is for OpenSCAD.
bool is_builtin_library(const std::string& file_name);

}  // namespace tenon::lang
