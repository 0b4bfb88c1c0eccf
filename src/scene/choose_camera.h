#pragma once

#include <span>

#include "scene/solid_extent.h"
#include "tenon/scene/section.h"
#include "tenon/scene/view_request.h"

namespace tenon {

/// The camera that a request and the scene's file lead to.
/// @param camera  the file's; may be none
/// @param cuts    a view that nobody chose shows their cut faces
Camera choose_camera(const ViewRequest& request, const std::optional<Camera>& camera, const CsgTree& tree,
                     std::span<const SectionCut> cuts);

/// Moves a camera, without turning it, to where the solid fills the picture, and looks at its middle.
/// @param filled  the share of the picture's width or height, whichever is filled first, that the solid takes
Camera fit_camera(const Camera& camera, SolidExtent& extent, double aspect, double filled);

}  // namespace tenon
