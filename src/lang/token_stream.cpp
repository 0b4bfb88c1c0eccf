#include "lang/token_stream.h"

#include <utility>

#include "lang/failure.h"

namespace tenon::lang {

namespace {

constexpr std::size_t deepest_include = 100;

}  // namespace

bool is_builtin_library(const std::string& file_name) {
  return file_name == "tenon.scad" || file_name.ends_with("/tenon.scad");
}

TokenStream::TokenStream(const SourceText& source, const SourceText* after, SourceFiles& files) : files_(&files) {
  if (after) lexers_.emplace_back(*after);
  lexers_.emplace_back(source);
  next_ = read();
}

Token TokenStream::take() {
  Token taken = std::move(next_);
  next_ = read();
  return taken;
}

Token TokenStream::read() {
  for (;;) {
    Token token = lexers_.back().next();
    if (token.kind == TokenKind::end && lexers_.size() > 1) {
      lexers_.pop_back();
    } else if (token.kind == TokenKind::include) {
      if (is_builtin_library(token.string)) continue;
      if (lexers_.size() >= deepest_include) {
        fail(token.at, "files include each other more than 100 deep; does a file include itself?");
      }
      lexers_.emplace_back(files_->read(SourceFiles::find(token.string, token.at), token.at));
    } else {
      return token;
    }
  }
}

}  // namespace tenon::lang
