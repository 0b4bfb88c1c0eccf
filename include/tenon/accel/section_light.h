#pragma once

#include <memory>

#include "tenon/accel/accelerator.h"

namespace tenon {

/// A section view whose light is that of the whole solid: what is seen is cut, and what was taken away still casts its
/// shadows. The cut faces lie inside of what was taken away; they are lit as if it were gone.
///
/// @param cut          over the tree of the section view
/// @param whole        over the tree as it was modelled, with the same leaves but for the planes
/// @param first_plane  the first leaf that is a plane (Scene::first_section_plane)
/// @return answers shadow rays and diffuse rays that start elsewhere than on a cut face by `whole`, all others by `cut`
std::unique_ptr<Accelerator> light_of_the_whole(std::unique_ptr<Accelerator> cut, std::unique_ptr<Accelerator> whole,
                                                LeafId first_plane);

}  // namespace tenon
