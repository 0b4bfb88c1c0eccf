#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tenon {

/// " (did you mean 'x'?)" with the likeliest of the candidates, or nothing.
std::string suggestion(std::string_view wrong, const std::vector<std::string_view>& candidates);

}  // namespace tenon
