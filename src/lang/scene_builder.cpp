#include "lang/scene_builder.h"

#include <algorithm>
#include <utility>

#include "lang/budget.h"

namespace tenon::lang {

bool are_flat(const Solids& parts) {
  const auto first = std::find_if(parts.begin(), parts.end(), [](const Solid& s) { return !s.is_nothing(); });
  return first != parts.end() && first->flat;
}

namespace {

// Shapes and solids do not mix: those like the first count.
std::vector<SceneNodeId> nodes_of(const Solids& parts) {
  const bool flat = are_flat(parts);
  std::vector<SceneNodeId> nodes;
  for (const Solid& part : parts) {
    if (part.extent == Solid::Extent::node && part.flat == flat) nodes.push_back(part.node);
  }
  return nodes;
}

bool any_everything(const Solids& parts, std::size_t first = 0) {
  return std::any_of(parts.begin() + static_cast<std::ptrdiff_t>(first), parts.end(),
                     [](const Solid& s) { return s.is_everything(); });
}

}  // namespace

Solid SceneBuilder::add(SceneNode node, bool flat) {
  if (model_.graph.nodes.size() >= most_nodes) throw BudgetExceeded{"the scene has more than 16 million nodes"};
  return Solid::of(model_.graph.add(std::move(node)), flat);
}

Solid SceneBuilder::unite(const Solids& parts) {
  if (any_everything(parts)) return Solid::everything();
  std::vector<SceneNodeId> nodes = nodes_of(parts);
  if (nodes.empty()) return Solid::nothing();
  if (nodes.size() == 1) return Solid::of(nodes.front(), are_flat(parts));
  return add({SetOperation::union_, std::move(nodes)}, are_flat(parts));
}

Solid SceneBuilder::intersect(const Solids& parts) {
  if (parts.empty() || std::any_of(parts.begin(), parts.end(), [](const Solid& s) { return s.is_nothing(); })) {
    return Solid::nothing();
  }
  std::vector<SceneNodeId> nodes = nodes_of(parts);
  if (nodes.empty()) return Solid::everything();
  if (nodes.size() == 1) return Solid::of(nodes.front(), are_flat(parts));
  return add({SetOperation::intersection, std::move(nodes)}, are_flat(parts));
}

Solid SceneBuilder::subtract(const Solids& parts) {
  if (parts.empty() || parts.front().is_nothing() || any_everything(parts, 1)) return Solid::nothing();
  if (parts.front().is_everything()) return complement({parts.begin() + 1, parts.end()});
  std::vector<SceneNodeId> nodes = nodes_of(parts);
  if (nodes.size() == 1) return Solid::of(nodes.front(), are_flat(parts));
  return add({SetOperation::difference, std::move(nodes)}, are_flat(parts));
}

Solid SceneBuilder::complement(const Solids& parts) {
  if (any_everything(parts)) return Solid::nothing();
  std::vector<SceneNodeId> nodes = nodes_of(parts);
  if (nodes.empty()) return Solid::everything();
  return add({SetOperation::complement, std::move(nodes)}, are_flat(parts));
}

template <class Content>
Solid SceneBuilder::wrap_any(const Content& content, const Solids& parts) {
  if (any_everything(parts)) return Solid::everything();
  std::vector<SceneNodeId> nodes = nodes_of(parts);
  if (nodes.empty()) return Solid::nothing();
  return add({content, std::move(nodes)}, are_flat(parts));
}

template Solid SceneBuilder::wrap_any(const Transform&, const Solids&);
template Solid SceneBuilder::wrap_any(const ColorAttribute&, const Solids&);
template Solid SceneBuilder::wrap_any(const MaterialAttribute&, const Solids&);
template Solid SceneBuilder::wrap_any(const CutFacesAttribute&, const Solids&);

Solid SceneBuilder::leaf(PrimitiveId primitive) {
  return add({PrimitiveLeaf{primitive}, {}}, false);
}

MaterialId SceneBuilder::intern(const Material& material) {
  // From the back: neighbours in a scene tend to share their material.
  for (std::size_t i = model_.materials.size(); i-- > 0;) {
    if (model_.materials[i] == material) return MaterialId{i};
  }
  model_.materials.push_back(material);
  return MaterialId{model_.materials.size() - 1};
}

}  // namespace tenon::lang
