#include "model_fingerprint.h"

#include <span>
#include <string_view>
#include <unordered_set>
#include <variant>

#include "tenon/base/fingerprint.h"
#include "tenon/lang/load.h"

namespace tenon {

std::string model_fingerprint(const Model& model) {
  Fingerprint print;
  print_csg_nodes(model, [&](std::string_view text) { print.add(text); });
  std::unordered_set<const TriangleMesh*> seen;
  for (const SceneNode& node : model.graph.nodes) {
    const auto* leaf = std::get_if<PrimitiveLeaf>(&node.content);
    if (leaf == nullptr) continue;
    for (const FieldValue& value : model.graph.primitives.values(leaf->primitive)) {
      const auto* mesh = std::get_if<SharedMesh>(&value);
      if (mesh == nullptr || !seen.insert(mesh->get()).second) continue;
      print.add(std::span<const Vec3>((*mesh)->vertices));
      print.add(std::span<const TriangleMesh::Corners>((*mesh)->triangles));
      print.add(std::span<const Vec3>((*mesh)->normals));
    }
  }
  for (const Light& light : model.lights) {
    if (light.map) print.add(std::span<const float>(light.map->rgb));
  }
  return print.text();
}

}  // namespace tenon
