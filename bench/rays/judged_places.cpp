#include "rays/judged_places.h"

#include <algorithm>
#include <functional>
#include <map>
#include <memory>
#include <random>
#include <vector>

#include "rays/winding_number.h"

namespace tenon::bench {

namespace {

/// Where points lie, by the definitions of the solids alone: meshes by their winding numbers.
class Membership {
 public:
  static Result<Membership> create(const CsgTree& tree) {
    Membership membership(tree);
    for (const Leaf& leaf : tree.leaves) {
      const std::string_view kind = tree.primitives.kind(leaf.primitive).name;
      const auto values = tree.primitives.values(leaf.primitive);
      if (kind == "mesh") {
        const auto& mesh = std::get<SharedMesh>(values[0]);
        auto& known = membership.meshes_[mesh.get()];
        if (!known) known = std::make_shared<const WindingNumber>(*mesh);
        membership.leaves_.push_back([winding = known](const Vec3& p) { return winding->at(p) > 0.5; });
      } else if (kind == "sphere") {
        membership.leaves_.push_back([r = std::get<double>(values[0])](const Vec3& p) { return dot(p, p) <= r * r; });
      } else if (kind == "cube") {
        const Vec3 size = std::get<Vec3>(values[0]);
        const Vec3 lower = std::get<bool>(values[1]) ? -0.5 * size : Vec3{};
        membership.leaves_.push_back([box = Box3{lower, lower + size}](const Vec3& p) { return box.contains(p); });
      } else {
        return Error{ErrorKind::input, "the check knows no " + std::string(kind), {}};
      }
    }
    return membership;
  }

  bool contains(const Vec3& p) const { return contains(p, tree_->root); }

 private:
  explicit Membership(const CsgTree& tree) : tree_(&tree) {}

  bool contains(const Vec3& p, CsgNodeId id) const {
    const CsgNode& node = (*tree_)[id];
    const auto children = tree_->children_of(node);
    const auto is_in = [&](CsgNodeId child) { return contains(p, child); };
    switch (node.operation) {
      case CsgOperation::leaf:
        return leaves_[node.leaf.get()]((*tree_)[node.leaf].placement.point_to_local(p));
      case CsgOperation::union_:
        return std::any_of(children.begin(), children.end(), is_in);
      case CsgOperation::intersection:
        return std::all_of(children.begin(), children.end(), is_in);
      case CsgOperation::difference:
        return is_in(children[0]) && std::none_of(children.begin() + 1, children.end(), is_in);
      case CsgOperation::complement:
        break;
    }
    return std::none_of(children.begin(), children.end(), is_in);
  }

  const CsgTree* tree_;
  std::map<const tenon::TriangleMesh*, std::shared_ptr<const WindingNumber>> meshes_;
  std::vector<std::function<bool(const Vec3&)>> leaves_;
};

}  // namespace

Result<JudgedPlaces> judge_places(const CsgTree& tree, const Accelerator& accelerator, std::size_t rays) {
  const Result<Membership> membership = Membership::create(tree);
  if (!membership) return membership.error();
  const auto context = accelerator.make_context();
  Box3 bounds;
  for (const Leaf& leaf : tree.leaves) bounds = hull(bounds, leaf.bounds);
  const double size = length(bounds.size()), reach = 2 * size;
  // Nearer to the surface than this the sum of the solid angles may not tell: each of them, of some thousand triangles,
  // comes with a rounding.
  const double shortest = 1e-9 * size;
  std::mt19937_64 random(1);
  const auto uniform = [&random] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  const auto point = [&] {
    const double x = uniform(), y = uniform(), z = uniform();
    return bounds.lower + Vec3{x, y, z} * bounds.size();
  };
  JudgedPlaces judged;
  std::vector<SolidSpan> spans;
  for (std::size_t i = 0; i < rays; ++i) {
    const Vec3 through = point();
    const Vec3 direction = normalize(point() - through);
    RayQuery query;
    query.ray = {through - reach * direction, direction};
    spans.clear();
    accelerator.all_spans(query, spans, *context);
    judged.met += spans.empty() ? 0 : 1;
    const auto judge = [&](double from, double to, bool inside) {
      if (to - from < shortest) return;
      ++judged.places;
      const Vec3 p = query.ray.origin + (0.5 * from + 0.5 * to) * direction;
      judged.wrong += membership->contains(p) != inside ? 1 : 0;
    };
    double outside_since = 0;
    for (const SolidSpan& span : spans) {
      judge(outside_since, span.t_in, false);
      judge(span.t_in, span.t_out, true);
      outside_since = span.t_out;
    }
    judge(outside_since, 2 * reach, false);
  }
  return judged;
}

}  // namespace tenon::bench
