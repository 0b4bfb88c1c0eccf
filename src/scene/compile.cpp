#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "csg/instance_plan.h"
#include "csg/minimum_enclosure.h"
#include "csg/prototype.h"
#include "csg/push_attributes.h"
#include "scene/choose_camera.h"
#include "scene/cut_tree.h"
#include "scene/default_lights.h"
#include "tenon/scene/scene.h"

namespace tenon {

namespace {

// OpenSCAD's cornfield yellow would do; a warm clay shows form better under a neutral light.
constexpr Rgba default_color{0.92, 0.76, 0.42, 1};
constexpr Rgba default_background{0.93, 0.95, 0.97, 1};
constexpr Rgba default_ambient{0.52, 0.52, 0.54, 1};

// Beer's law. No light at all is left of a band of colour 0, however thin the solid.
Rgb attenuation_of(const Material& material) {
  const Rgb kept = linear_from_srgb(material.attenuation_color);
  const auto per_length = [&](double band) { return std::max(0.0, -std::log(band) / material.attenuation_distance); };
  return {per_length(kept.r), per_length(kept.g), per_length(kept.b)};
}

/// Gives each leaf the one material that follows from its `material` and its `color`, and numbers the media.
class MaterialCompiler {
 public:
  MaterialCompiler(std::vector<Material> named, Scene& scene) : named_(std::move(named)), scene_(scene) {
    scene_.default_material.name = "default";
    scene_.default_material.color = default_color;
  }

  void assign(CsgTree& tree) {
    for (Leaf& leaf : tree.leaves) {
      assign(leaf, leaf.color ? std::optional(tree.colors[leaf.color.get()]) : std::nullopt);
      tree.has_media |= leaf.medium > medium_opaque;
    }
    for (const auto& prototype : tree.prototypes) assign(prototype->tree());
  }

 private:
  void assign(Leaf& leaf, const std::optional<Rgba>& color) {
    if (leaf.material || color) leaf.material = resolve(leaf.material, color);
    const Material& material = scene_.material(leaf.material);
    leaf.priority = material.priority;
    leaf.medium = medium_of(material);
  }

  static std::string key_of(MaterialId material, const std::optional<Rgba>& color) {
    std::string key = material ? std::to_string(material.get()) : "-";
    if (color) {
      for (const double c : {color->r, color->g, color->b, color->a}) key += ' ' + std::to_string(c);
    }
    return key;
  }

  MaterialId resolve(MaterialId named, const std::optional<Rgba>& color) {
    const auto [found, is_new] = resolved_.try_emplace(key_of(named, color), MaterialId{scene_.materials.size()});
    if (is_new) scene_.materials.push_back(combine(named, color));
    return found->second;
  }

  // A material's own colour stands; else `color` gives it. `color` alone with an opacity lets light through unbent.
  Material combine(MaterialId named, const std::optional<Rgba>& color) const {
    Material m = named ? named_[named.get()] : scene_.default_material;
    const bool own_color = named && m.color;
    // Glass that nobody coloured is clear.
    const bool is_clear = named && m.model == MaterialModel::dielectric;
    if (!own_color) m.color = color ? color : is_clear ? Rgba{1, 1, 1, 1} : default_color;
    if (!named && color && color->a < 1) {
      m.model = MaterialModel::whitted;
      m.kd = color->a;
      m.ks = 0;
      m.kt = 1 - color->a;
      m.ior = 1;
    }
    return m;
  }

  // Solids of one transparent material are one medium; all opaque ones are another.
  MediumId medium_of(const Material& material) {
    if (!material.is_transparent()) return medium_opaque;
    for (std::size_t i = 0; i < media_.size(); ++i) {
      if (media_[i] == material) return static_cast<MediumId>(i + 2);
    }
    media_.push_back(material);
    scene_.media.push_back({material.ior, attenuation_of(material)});
    return static_cast<MediumId>(media_.size() + 1);
  }

  std::vector<Material> named_;
  Scene& scene_;
  std::map<std::string, MaterialId> resolved_;
  std::vector<Material> media_;
};

Box3 solid_bounds(const CsgTree& tree) {
  if (!tree.root) return Box3::empty();
  return node_enclosures(tree)[tree.root.get()];
}

// The bounds without the rounding that was added outward: their ends at the nearest multiples of a power of two that is
// no larger than the tolerance, so that whole numbers are whole again.
Box3 on_tolerance_grid(const Box3& bounds, double tolerance) {
  if (!bounds.is_bounded() || !(tolerance > 0)) return bounds;
  const double step = std::ldexp(1.0, std::ilogb(tolerance));
  const auto snapped = [step](const Vec3& v) {
    return Vec3{std::round(v.x / step) * step, std::round(v.y / step) * step, std::round(v.z / step) * step} + Vec3{};
  };
  return {snapped(bounds.lower), snapped(bounds.upper)};
}

// The bounds lights are placed by; a scene without any (a half-space alone) is lit around the origin.
Box3 lit_bounds(const CsgTree& tree) {
  Box3 bounds = solid_bounds(tree);
  if (bounds.is_bounded()) return bounds;
  bounds = Box3::empty();
  for (const Leaf& leaf : tree.leaves) {
    if (leaf.bounds.is_bounded()) bounds = hull(bounds, leaf.bounds);
  }
  return bounds.is_bounded() ? bounds : Box3{{-1, -1, -1}, {1, 1, 1}};
}

// Counts what a tree spells out, `times` as often.
void count_parts(const CsgTree& tree, std::size_t times, SceneFigures& figures,
                 std::map<const PrimitiveKind*, std::size_t>& by_kind) {
  std::vector<std::size_t> instances(tree.prototypes.size());
  for (const Leaf& leaf : tree.leaves) {
    if (leaf.prototype) {
      instances[leaf.prototype.get()] += times;
    } else {
      by_kind[&tree.primitives.kind(leaf.primitive)] += times;
      figures.primitives += times;
    }
  }
  for (const CsgNode& node : tree.nodes) figures.operations += node.operation != CsgOperation::leaf ? times : 0;
  for (std::size_t i = 0; i < instances.size(); ++i) {
    figures.instances += instances[i];
    count_parts(tree.prototypes[i]->tree(), instances[i], figures, by_kind);
  }
}

}  // namespace

Result<Scene> compile_scene(Model model, Diagnostics& diagnostics, const ViewRequest& view, double most_leaves) {
  std::vector<bool> is_transparent;
  for (const Material& material : model.materials) is_transparent.push_back(material.is_transparent());
  const InstancePlan plan = plan_instances(model.graph, std::move(is_transparent), most_leaves);
  auto tree = std::make_shared<CsgTree>(push_attributes(std::move(model.graph), diagnostics, plan));
  if (tree->leaves.empty()) {
    return Error{ErrorKind::input, "the scene holds no solid; add one, such as cube(10);", {}};
  }
  Scene scene;
  MaterialCompiler materials(std::move(model.materials), scene);
  materials.assign(*tree);

  if (view.keeps_light && !model.section.empty()) scene.whole = std::make_shared<CsgTree>(*tree);
  const Result<LeafId> first_plane = cut_tree(*tree, model.section);
  if (!first_plane) return first_plane.error();
  scene.first_section_plane = *first_plane;
  // Whoever chose a camera may look at nothing on purpose.
  if ((!model.section.empty() || !(view.camera || model.camera)) && SolidExtent(*tree).is_empty()) {
    diagnostics.warn(model.section.empty()
                         ? "nothing is left of the scene; its differences and intersections hold no point"
                         : "nothing is left of the scene; each cut takes away the side that its normal points to");
  }

  scene.camera = choose_camera(view, model.camera, *tree, model.section);
  scene.lights = model.lights.empty() ? default_lights(lit_bounds(*tree), scene.camera) : std::move(model.lights);
  scene.background = linear_from_srgb(model.background.value_or(default_background));
  scene.shows_environment = !model.background;
  scene.ambient = linear_from_srgb(model.ambient.value_or(default_ambient));
  scene.tree = std::move(tree);
  return scene;
}

SceneFigures scene_figures(const Scene& scene) {
  const CsgTree& tree = *scene.tree;
  SceneFigures figures;
  std::map<const PrimitiveKind*, std::size_t> by_kind;
  count_parts(tree, 1, figures, by_kind);
  for (const PrimitiveKind& kind : PrimitiveStore::kinds()) {
    if (const auto count = by_kind.find(&kind); count != by_kind.end()) {
      figures.primitives_by_kind.emplace_back(kind.name, count->second);
    }
  }
  figures.depth = tree.depth();
  figures.bounds = on_tolerance_grid(solid_bounds(tree), tree.tolerance.distance);
  figures.tolerance = tree.tolerance.distance;
  figures.materials = scene.materials.size();
  figures.lights = scene.lights.size();
  return figures;
}

std::string_view primitive_name(const Scene& scene, LeafId leaf) {
  return scene.tree->primitives.kind((*scene.tree)[leaf].primitive).name;
}

}  // namespace tenon
