#pragma once

#include <string_view>

namespace tenon {

/// The version of the library and its programs, such as `0.1.0`.
std::string_view version();

}  // namespace tenon
