#pragma once

#include <string>

#include "tenon/base/error.h"
#include "tenon/scene/scene.h"

namespace tenon {

/// A scene in the language of POV-Ray 3.7 (`tenon convert -o x.pov`): the solids as they are, not tessellated, with the
/// camera, the lights, and materials under which POV-Ray computes the same illumination model. The picture has the
/// proportions POV-Ray is asked for.
///
/// Three things differ in kind. POV-Ray has one refractive index for a solid, so light that passes from one transparent
/// solid straight into another is bent as if there were air between them. It keeps the skin of a face that lies in the
/// face of what is subtracted. And where solids of several materials overlap, a cut through them shows a mixture.
/// @param depth  levels of the tree of rays
/// @return the text, or an input error: a camera that looks nowhere, a primitive POV-Ray has nothing for, or the
///         complement of nothing
Result<std::string> print_pov(const Scene& scene, int depth);

}  // namespace tenon
