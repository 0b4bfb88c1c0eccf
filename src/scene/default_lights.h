#pragma once

#include <vector>

#include "tenon/math/box3.h"
#include "tenon/scene/camera.h"
#include "tenon/scene/light.h"

namespace tenon {

/// Lights for a scene that names none: a key and a fill light that stand where the camera does, so that whatever side
/// is shown is lit well, and a weaker one beside the eye.
std::vector<Light> default_lights(const Box3& bounds, const Camera& camera);

}  // namespace tenon
