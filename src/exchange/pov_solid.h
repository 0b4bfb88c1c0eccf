#pragma once

#include "exchange/pov_text.h"
#include "tenon/base/error.h"
#include "tenon/scene/scene.h"

namespace tenon {

/// Writes the solid of a scene as POV-Ray objects. Materials are the declared identifiers pov_material_name() gives.
Status print_pov_solid(const Scene& scene, PovText& out);

/// The identifier of a material in the file; none is the scene's default material.
std::string pov_material_name(MaterialId id);

}  // namespace tenon
