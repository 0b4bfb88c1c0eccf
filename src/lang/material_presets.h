#pragma once

#include <string_view>

#include "tenon/scene/material.h"

namespace tenon::lang {

/// What a material of this name is like before its own arguments: "glass", "water", "mirror", "chrome", "gold",
/// "silver", "copper", "plastic", "matte"; any other name begins as Material does.
Material material_preset(std::string_view name);

}  // namespace tenon::lang
