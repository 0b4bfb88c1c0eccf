#include "csg/prototype.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <unordered_map>
#include <utility>

#include "csg/classifier.h"
#include "csg/enclosures.h"
#include "csg/minimum_enclosure.h"
#include "primitive/dispatch.h"

namespace tenon {

namespace {

// The number of each leaf's first face, if all faces can be numbered; two for each are wanted.
std::optional<std::vector<std::uint32_t>> number_faces(const CsgTree& tree) {
  std::vector<std::uint32_t> first{0};
  constexpr std::uint64_t most = std::numeric_limits<std::int32_t>::max();
  for (const Leaf& leaf : tree.leaves) {
    const std::optional<std::uint32_t> count = tenon::face_count(tree.primitives, leaf.primitive);
    if (!count || first.back() + std::uint64_t{*count} > most) return std::nullopt;
    first.push_back(first.back() + *count);
  }
  return first;
}

}  // namespace

/// The leaves as a classifier sees them, for one line in the prototype's frame.
class Prototype::Source {
 public:
  explicit Source(const CsgTree& tree) : tree_(&tree) {}

  /// @param start  the leaf and the face that the ray starts on; no leaf for a ray that does not
  void set_ray(const LocalRay& ray, const LeafFace& start) {
    ray_ = ray;
    start_ = start;
  }

  void crossings(LeafId id, Spans& out) {
    const Leaf& leaf = (*tree_)[id];
    ray_.on_face = start_.leaf == id ? static_cast<int>(start_.face) : -1;
    const std::size_t begin = out.size();
    tenon::spans(tree_->primitives, leaf.primitive, leaf.placement, ray_, out);
    if (!start_.leaf) return;
    // What may coincide with the face that the ray starts on does, or it would not have been one run with it.
    for (std::size_t i = begin; i < out.size(); ++i) {
      if (std::fabs(out[i].t) <= out[i].bound) out[i].t = 0;
    }
  }
  bool has_media() const { return false; }
  MediumId medium(LeafId) const { return medium_opaque; }
  double priority(LeafId) const { return 0; }

 private:
  const CsgTree* tree_;
  LocalRay ray_;
  LeafFace start_;
};

class Prototype::Scratch {
 public:
  explicit Scratch(const Prototype& of)
      : classifier(ExpressionState(of.expression_), Source(of.tree_), of.tree_.leaves.size()) {}

  Classifier<ExpressionState, Source> classifier;
};

std::shared_ptr<Prototype> Prototype::create(CsgTree tree) {
  if (!tree.root) return nullptr;
  for (const Leaf& leaf : tree.leaves) {
    if (is_surface(tree.primitives, leaf.primitive)) return nullptr;
  }
  const Box3 enclosure = node_enclosures(tree)[tree.root.get()];
  std::optional<std::vector<std::uint32_t>> first_face = number_faces(tree);
  if (!enclosure.is_bounded() || !first_face) return nullptr;
  return std::shared_ptr<Prototype>(new Prototype(std::move(tree), enclosure, std::move(*first_face)));
}

bool Prototype::knows_materials() const {
  return std::any_of(tree_.leaves.begin(), tree_.leaves.end(), [&](const Leaf& leaf) {
    const Prototype* within = prototype_of(tree_, leaf);
    return leaf.material || leaf.color || (within != nullptr && within->knows_materials_);
  });
}

Prototype::Prototype(CsgTree tree, const Box3& enclosure, std::vector<std::uint32_t> first_face)
    : tree_(std::move(tree)),
      knows_materials_(knows_materials()),
      expression_(Expression::compile(tree_)),
      enclosure_(enclosure),
      first_face_(std::move(first_face)),
      life_(std::make_shared<const char>()) {
  std::vector<Box3> boxes;
  for (const EnclosedLeaf& leaf : enclosed_leaves(tree_)) {
    boxed_.push_back(leaf.leaf);
    boxes.push_back(leaf.box);
    bounds_ = hull(bounds_, leaf.box);
  }
  for (std::size_t i = 0; i < tree_.leaves.size(); ++i) {
    if (!tree_.leaves[i].bounds.is_bounded()) unbounded_.emplace_back(i);
  }
  hierarchy_ = MeshBvh(boxes);
}

// One for each thread and prototype; those of prototypes that are gone go when another is made.
Prototype::Scratch& Prototype::scratch() const {
  struct Entry {
    std::weak_ptr<const char> life;
    std::unique_ptr<Scratch> scratch;
  };
  thread_local std::unordered_map<const char*, Entry> entries;
  if (const auto known = entries.find(life_.get()); known != entries.end() && !known->second.life.expired()) {
    return *known->second.scratch;
  }
  std::erase_if(entries, [](const auto& entry) { return entry.second.life.expired(); });
  return *entries.insert_or_assign(life_.get(), Entry{life_, std::make_unique<Scratch>(*this)}).first->second.scratch;
}

Prototype::Face Prototype::face_of(std::uint32_t number) const {
  const std::uint32_t face = number / 2;
  const auto behind = std::upper_bound(first_face_.begin(), first_face_.end(), face);
  const auto leaf = static_cast<std::size_t>(behind - first_face_.begin()) - 1;
  return {LeafId{leaf}, face - first_face_[leaf], number % 2 != 0};
}

std::uint32_t Prototype::number_of(const Face& face) const {
  const std::uint32_t number = first_face_[face.leaf.get()] + face.face;
  assert(number < first_face_[face.leaf.get() + 1]);
  return 2 * number + (face.opposite ? 1 : 0);
}

void Prototype::spans(const LocalRay& ray, Spans& out) const {
  auto& classifier = scratch().classifier;
  LeafFace start;
  if (ray.on_face >= 0) {
    const Face face = face_of(static_cast<std::uint32_t>(ray.on_face));
    start = {face.leaf, face.face};
  }
  classifier.source().set_ray(ray, start);
  classifier.start(-std::numeric_limits<double>::infinity());
  for (const LeafId leaf : unbounded_) classifier.reveal(leaf);
  hierarchy_.walk(MeshLine(ray, bounds_), {}, [&](std::uint32_t i) { classifier.reveal(boxed_[i]); });
  while (const std::optional<Run> run = classifier.settle(std::numeric_limits<double>::infinity())) {
    const bool entering = run->after != medium_outside;
    const std::uint32_t face = number_of({run->surface.leaf, run->surface.face, run->leaf_entering != entering});
    out.push_back({run->t, run->bound, face, entering, false});
  }
}

Region Prototype::classify(const LocalBox& box) const {
  const bool is_far = hierarchy_.walk(box.bounds, [](std::uint32_t) { return false; });
  return is_far ? Region::outside : Region::straddles;
}

Vec3 Prototype::normal(const Vec3& point, std::uint32_t number) const {
  const Face face = face_of(number);
  const Leaf& leaf = tree_[face.leaf];
  const Vec3 n = leaf.placement.normal_to_world(
      tenon::normal(tree_.primitives, leaf.primitive, leaf.placement.point_to_local(point), face.face));
  return face.opposite ? -n : n;
}

MaterialId Prototype::face_material(const Vec3& point, std::uint32_t number) const {
  if (!knows_materials_) return {};
  const Face face = face_of(number);
  const MaterialId own = tenon::face_material(tree_, {face.leaf, face.face}, point);
  if (own && !tree_[face.leaf].shows_what_it_cut) return own;
  const MaterialId owner = material_at(point);
  return owner ? owner : own;
}

// A leaf whose surface the point lies on, or as good as, is taken to hold it where that makes more of space solid.
MaterialId Prototype::material_at(const Vec3& point) const {
  if (!knows_materials_) return {};
  ExpressionState state(expression_);
  state.reset();
  const Box3 box{point, point};
  std::vector<LeafId> holding;
  const auto ask = [&](LeafId id) {
    const Leaf& leaf = tree_[id];
    const Region region = tenon::classify(tree_.primitives, leaf.primitive, leaf.placement.to_local(box));
    const bool is_tool = expression_.leaves[id.get()].complemented;
    if (region == Region::outside || (region == Region::straddles && is_tool)) return;
    state.flip(id);
    holding.push_back(id);
  };
  for (const LeafId leaf : unbounded_) ask(leaf);
  hierarchy_.walk(box, [&](std::uint32_t i) {
    ask(boxed_[i]);
    return true;
  });
  LeafId owner;
  for (const LeafId leaf : holding) {
    if (!state.owns(leaf)) continue;
    const double priority = tree_[leaf].priority, best = owner ? tree_[owner].priority : priority;
    if (!owner || priority > best || (priority == best && leaf < owner)) owner = leaf;
  }
  return owner ? owner_material(tree_, owner, point) : MaterialId{};
}

const Prototype* prototype_of(const CsgTree& tree, const Leaf& leaf) {
  return leaf.prototype ? tree.prototypes[leaf.prototype.get()].get() : nullptr;
}

MaterialId face_material(const CsgTree& tree, const LeafFace& surface, const Vec3& point) {
  const Leaf& leaf = tree[surface.leaf];
  if (const Prototype* prototype = prototype_of(tree, leaf)) {
    const MaterialId own = prototype->face_material(leaf.placement.point_to_local(point), surface.face);
    if (own) return own;
  }
  return leaf.material;
}

MaterialId owner_material(const CsgTree& tree, LeafId owner, const Vec3& point) {
  const Leaf& leaf = tree[owner];
  if (const Prototype* prototype = prototype_of(tree, leaf)) {
    const MaterialId own = prototype->material_at(leaf.placement.point_to_local(point));
    if (own) return own;
  }
  return leaf.material;
}

}  // namespace tenon
