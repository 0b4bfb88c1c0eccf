#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace tenon {

/// 16 hexadecimal digits that tell texts apart, but not in the face of somebody who wants to deceive: the 64-bit FNV-1a
/// hash (Fowler, Noll, Vo).
std::string fingerprint(std::string_view text);

}  // namespace tenon
