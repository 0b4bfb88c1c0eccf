#pragma once

#include <string>

#include "tenon/scene/model.h"

namespace tenon {

/// Tells scenes apart by all that a picture of them depends on: the evaluated tree, and what it only names, the
/// triangles of meshes and the pictures of environment lights.
std::string model_fingerprint(const Model& model);

}  // namespace tenon
