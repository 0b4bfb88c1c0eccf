#include "lang/source_text.h"

#include <algorithm>
#include <utility>

#include "lang/failure.h"

namespace tenon::lang {

SourceText::SourceText(std::string name_, std::string directory_, std::string text_)
    : name(std::move(name_)), directory(std::move(directory_)), text(std::move(text_)) {
  line_starts.push_back(0);
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\n') line_starts.push_back(static_cast<std::uint32_t>(i + 1));
  }
}

SourceLocation locate(Place at) {
  if (!at.source) return {};
  const SourceText& source = *at.source;
  const auto next_line = std::upper_bound(source.line_starts.begin(), source.line_starts.end(), at.offset);
  const auto line = static_cast<std::size_t>(next_line - source.line_starts.begin());
  const std::size_t begin = source.line_starts[line - 1];
  std::size_t end = next_line == source.line_starts.end() ? source.text.size() : *next_line - 1;
  if (end > begin && source.text[end - 1] == '\r') --end;
  return {source.name, static_cast<int>(line), static_cast<int>(at.offset - begin) + 1,
          source.text.substr(begin, end - begin)};
}

void fail(Place at, std::string message, ErrorKind kind) {
  throw Failure{{kind, std::move(message), locate(at)}};
}

}  // namespace tenon::lang
