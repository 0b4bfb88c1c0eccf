#include "scene/solid_extent.h"

#include <algorithm>
#include <utility>

#include "csg/minimum_enclosure.h"
#include "primitive/dispatch.h"

namespace tenon {

namespace {

using cells::LocalExpression;
using cells::Symbol;

// A 2048th of the whole is less than half a pixel of most pictures.
constexpr double relative_resolution = 0x1p-11;
// A face that lies askew and is flat towards n fills a great many small parts. After so many the bound at hand is
// taken, which is safe.
constexpr int most_parts = 1 << 16;

Box3 finite_enclosure(const CsgTree& tree) {
  const Box3 box = tree.root ? node_enclosures(tree)[tree.root.get()] : Box3::empty();
  if (box.is_bounded() || box.is_empty()) return box;
  Box3 bounded;
  for (const Leaf& leaf : tree.leaves) {
    if (leaf.bounds.is_bounded()) bounded = hull(bounded, leaf.bounds);
  }
  bounded = intersection(box, bounded);
  return bounded.is_empty() ? Box3{{-1, -1, -1}, {1, 1, 1}} : bounded;
}

double box_support(const Box3& box, const Vec3& n) {
  return dot(n, {n.x < 0 ? box.lower.x : box.upper.x, n.y < 0 ? box.lower.y : box.upper.y,
                 n.z < 0 ? box.lower.z : box.upper.z});
}

int longest_axis(const Vec3& size) {
  if (size.x >= size.y && size.x >= size.z) return 0;
  return size.y >= size.z ? 1 : 2;
}

}  // namespace

SolidExtent::SolidExtent(const CsgTree& tree)
    : tree_(tree),
      enclosure_(finite_enclosure(tree)),
      leaf_regions_(tree),
      whole_(cells::whole_expression(tree)),
      leaf_supports_(tree.leaves.size()) {
  if (!enclosure_.is_empty()) resolution_ = relative_resolution * max_component(enclosure_.size());
}

double SolidExtent::support(const Vec3& n) {
  if (enclosure_.is_empty()) return -Box3::inf;
  for (std::size_t i = 0; i < tree_.leaves.size(); ++i) {
    const Leaf& leaf = tree_.leaves[i];
    leaf_supports_[i] = world_support(tree_.primitives, leaf.primitive, leaf.placement, n);
  }
  parts_.clear();
  add_part(enclosure_, {{}, whole_, Box3::inf, -1, false}, n);
  for (int count = 0; !parts_.empty(); ++count) {
    if (parts_.front().inside || count == most_parts || is_small(parts_.front().box)) return parts_.front().bound;
    std::pop_heap(parts_.begin(), parts_.end(), reaches_less);
    const Part part = std::move(parts_.back());
    parts_.pop_back();
    const int axis = longest_axis(part.box.size());
    Box3 low = part.box, high = part.box;
    low.upper[axis] = high.lower[axis] = part.box.center()[axis];
    add_part(low, part, n);
    add_part(high, part, n);
  }
  return -Box3::inf;
}

void SolidExtent::add_part(const Box3& box, const Part& whole, const Vec3& n) {
  Part part{box, {}, std::min(whole.bound, box_support(box, n)), whole.depth + 1, false};
  const cells::Folded folded = folder_.fold(
      whole.expression, [&](LeafId id) { return leaf_regions_.classify(id, box); }, part.expression);
  if (folded.constant && !folded.value) return;
  part.inside = folded.constant;
  if (!part.inside) part.bound = std::min(part.bound, expression_support(part.expression));
  parts_.push_back(std::move(part));
  std::push_heap(parts_.begin(), parts_.end(), reaches_less);
}

// How far the primitives allow it: a union as far as the farthest of its operands, an intersection as far as the
// nearest, and what lies outside a primitive may reach anywhere.
double SolidExtent::expression_support(const LocalExpression& expression) const {
  struct Open {
    bool all;
    std::size_t end;
    double bound;
  };
  std::vector<Open> open{{true, expression.size(), Box3::inf}};
  const auto take = [&open](double bound) {
    Open& operation = open.back();
    operation.bound = operation.all ? std::min(operation.bound, bound) : std::max(operation.bound, bound);
  };
  for (std::size_t at = 0; at < expression.size();) {
    const Symbol& s = expression[at++];
    if (s.kind == Symbol::Kind::leaf) {
      take(s.complemented ? Box3::inf : leaf_supports_[s.leaf.get()]);
    } else {
      const bool all = s.kind == Symbol::Kind::all_of;
      open.push_back({all, at - 1 + s.size, all ? Box3::inf : -Box3::inf});
    }
    while (open.size() > 1 && open.back().end == at) {
      const double bound = open.back().bound;
      open.pop_back();
      take(bound);
    }
  }
  return open.front().bound;
}

}  // namespace tenon
