#pragma once

#include <memory>
#include <vector>

#include "tenon/base/diagnostics.h"
#include "tenon/base/error.h"
#include "tenon/csg/hit.h"
#include "tenon/math/box3.h"
#include "tenon/scene/camera.h"
#include "tenon/scene/light.h"
#include "tenon/scene/material.h"
#include "tenon/scene/model.h"
#include "tenon/scene/view_request.h"

namespace tenon {

struct CsgTree;

/// What fills transparent solids of one material, and the space around all solids.
struct Medium {
  double ior = 1;   ///< index of refraction
  Rgb attenuation;  ///< of light, per unit of length: exp(-attenuation x length) of it is left (Beer's law)
};

/// A scene ready to be traced: attributes pushed to the leaves, camera and lights chosen where the file has none.
struct Scene {
  std::shared_ptr<const CsgTree> tree;
  std::vector<Material> materials;  ///< indexed by MaterialId; each has its colour
  Material default_material;        ///< where Hit::material is none
  std::vector<Light> lights;
  Camera camera;
  Rgb background;                        ///< linear
  bool shows_environment = true;         ///< behind everything stands an environment light, when there is one
  Rgb ambient;                           ///< linear; Ia of the course
  std::shared_ptr<const CsgTree> whole;  ///< the tree without its cuts, where these keep their light; else none
  LeafId first_section_plane;            ///< this leaf and all behind it are planes of the section view; none without
  std::vector<Medium> media = std::vector<Medium>(2);  ///< indexed by MediumId; outside and opaque: nothing

  const Material& material(MaterialId id) const { return id ? materials[id.get()] : default_material; }
};

/// Up to this many primitives, a scene that repeats itself is traced as if it did not: that is faster. But each takes
/// up to some ten microseconds and a kilobyte to build, so that of more the first picture would be late.
inline constexpr double most_spelled_out = 1 << 15;

/// Compiles a model.
/// @param view         how it is to be looked at
/// @param most_leaves  with more primitives than this, subtrees that occur often are stored once
/// @return the scene, or an error when it holds no solid at all
Result<Scene> compile_scene(Model model, Diagnostics& diagnostics, const ViewRequest& view = {},
                            double most_leaves = most_spelled_out);

/// What `tenon info` tells about a scene.
struct SceneFigures {
  std::size_t primitives = 0;  ///< counted wherever they stand
  std::size_t instances = 0;   ///< of solids that are stored once
  std::vector<std::pair<std::string, std::size_t>> primitives_by_kind;
  std::size_t operations = 0;
  int depth = 0;         ///< of the CSG tree as modelled; a lone primitive has depth 1
  Box3 bounds;           ///< of the solid, by the enclosures of its tree
  double tolerance = 0;  ///< see Tolerance
  std::size_t materials = 0;
  std::size_t lights = 0;
};
SceneFigures scene_figures(const Scene& scene);

/// What `tenon trace` says about the primitive of a hit: the name of its kind, and its number in tree order.
std::string_view primitive_name(const Scene& scene, LeafId leaf);

}  // namespace tenon
