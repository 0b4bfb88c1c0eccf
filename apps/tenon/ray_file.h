#pragma once

#include <string>
#include <vector>

#include "tenon/base/error.h"
#include "tenon/math/ray.h"

namespace tenon {

/// Reads rays, one a line: `ox oy oz dx dy dz`. Blank lines are passed over, and so is the rest of a line from #.
/// @param path  "-" reads standard input
/// @return the rays, or the first error with its place: a line that is no ray, a direction that leads nowhere
Result<std::vector<Ray>> read_rays(const std::string& path);

/// The same from text; `name` stands for the file in messages.
Result<std::vector<Ray>> parse_rays(std::string_view text, const std::string& name);

}  // namespace tenon
