#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace tenon::lang {

/// Bytes of the code point that begins with this byte; 1 for a byte that begins none, so that a scan always advances.
inline std::size_t utf8_length(char lead) {
  const auto byte = static_cast<unsigned char>(lead);
  return byte < 0xC0 ? 1 : byte < 0xE0 ? 2 : byte < 0xF0 ? 3 : 4;
}

/// Appends a code point; false (and nothing appended) for 0, a surrogate or what lies beyond Unicode.
bool append_utf8(std::uint32_t code_point, std::string& text);
/// Removes the first code point from `text` and returns it; malformed bytes come as they are.
std::uint32_t take_code_point(std::string_view& text);
std::size_t count_code_points(std::string_view text);

}  // namespace tenon::lang
