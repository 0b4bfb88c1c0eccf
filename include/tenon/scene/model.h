#pragma once

#include <optional>
#include <vector>

#include "tenon/csg/scene_graph.h"
#include "tenon/math/color.h"
#include "tenon/scene/camera.h"
#include "tenon/scene/light.h"
#include "tenon/scene/material.h"
#include "tenon/scene/section.h"

namespace tenon {

/// What a scene file says: the graph as modelled, and what stands around it.
struct Model {
  SceneGraph graph;
  std::vector<Material> materials;  ///< indexed by MaterialId
  std::vector<Light> lights;        ///< empty: a studio light is chosen from the bounds
  std::optional<Camera> camera;     ///< none: a view is chosen from the bounds
  std::vector<SectionCut> section;  ///< what a section view takes away
  std::optional<Rgba> background;
  std::optional<Rgba> ambient;  ///< Ia, the ambient light of the course
};

}  // namespace tenon
