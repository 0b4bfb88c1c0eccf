#include "primitive/mesh_bvh.h"

#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace tenon {

namespace {

float below(double value) {
  const auto rounded = static_cast<float>(value);
  return rounded <= value ? rounded : std::nextafter(rounded, -std::numeric_limits<float>::infinity());
}
float above(double value) {
  const auto rounded = static_cast<float>(value);
  return rounded >= value ? rounded : std::nextafter(rounded, std::numeric_limits<float>::infinity());
}

std::vector<Box3> boxes_of(const TriangleMesh& mesh) {
  std::vector<Box3> boxes(mesh.triangles.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (const Vec3& p : mesh.corners(i)) boxes[i] = hull(boxes[i], p);
  }
  return boxes;
}

}  // namespace

class MeshBvh::Builder {
 public:
  Builder(std::vector<Box3> boxes, MeshBvh& bvh) : bvh_(bvh), boxes_(std::move(boxes)) {
    bvh_.order_.resize(boxes_.size());
    std::iota(bvh_.order_.begin(), bvh_.order_.end(), 0);
  }

  void build() {
    if (!boxes_.empty()) add_node({0, boxes_.size()}, 0);
  }

 private:
  struct Range {
    std::size_t begin, end;
    std::size_t size() const { return end - begin; }
  };

  std::uint32_t add_node(const Range& range, int depth) {
    const std::size_t index = bvh_.nodes_.size();
    bvh_.nodes_.emplace_back();
    std::array<Range, width> parts{range};
    std::size_t count = 1;
    while (count < width) {
      const auto largest = std::max_element(parts.begin(), parts.begin() + count,
                                            [](const Range& a, const Range& b) { return a.size() < b.size(); });
      if (largest->size() <= leaf_size) break;
      const std::size_t middle = split(*largest, depth);
      parts[count++] = {middle, largest->end};
      largest->end = middle;
    }
    for (std::size_t i = 0; i < width; ++i) {
      Box3 box;
      Child child;
      if (i < count) {
        for (std::size_t k = parts[i].begin; k < parts[i].end; ++k) box = hull(box, boxes_[bvh_.order_[k]]);
        child = parts[i].size() <= leaf_size
                    ? Child{static_cast<std::uint32_t>(parts[i].begin), static_cast<std::uint32_t>(parts[i].size())}
                    : Child{add_node(parts[i], depth + 1), 0};
      }
      Node& node = bvh_.nodes_[index];
      node.children[i] = child;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        node.lower[axis][i] = below(box.lower[static_cast<int>(axis)]);
        node.upper[axis][i] = above(box.upper[static_cast<int>(axis)]);
      }
    }
    return static_cast<std::uint32_t>(index);
  }

  // Reorders a range into two parts, none of them empty.
  // @return where the second begins
  std::size_t split(const Range& range, int depth) {
    Box3 centers;
    for (std::size_t k = range.begin; k < range.end; ++k) centers = hull(centers, boxes_[bvh_.order_[k]].center());
    const Vec3 size = centers.size();
    const std::size_t half = range.begin + range.size() / 2;
    const Cut cut = depth < deepest_by_cost ? best_cut(range, centers) : Cut{};
    const auto begin = bvh_.order_.begin();
    const auto at = [begin](std::size_t i) { return begin + static_cast<std::ptrdiff_t>(i); };
    if (cut.cost < Box3::inf) {
      const auto middle = std::partition(at(range.begin), at(range.end), [&](std::uint32_t t) {
        return bin_of(boxes_[t].center()[cut.axis], centers, cut.axis) <= cut.bin;
      });
      return static_cast<std::size_t>(middle - begin);
    }
    const int longest = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    std::nth_element(at(range.begin), at(half), at(range.end), [&](std::uint32_t a, std::uint32_t b) {
      const double ca = boxes_[a].center()[longest], cb = boxes_[b].center()[longest];
      return ca != cb ? ca < cb : a < b;
    });
    return half;
  }

  static constexpr std::size_t bins = 16;
  struct Cut {
    double cost = Box3::inf;
    int axis = 0;
    std::size_t bin = 0;  // the last of the first part
  };

  static std::size_t bin_of(double center, const Box3& centers, int axis) {
    const double share = (center - centers.lower[axis]) / (centers.upper[axis] - centers.lower[axis]);
    return std::min(static_cast<std::size_t>(share * bins), bins - 1);
  }

  Cut best_cut(const Range& range, const Box3& centers) const {
    Cut best;
    for (int axis = 0; axis < 3; ++axis) {
      const double extent = centers.upper[axis] - centers.lower[axis];
      if (!(extent > 0) || !std::isfinite(bins / extent)) continue;
      std::array<Box3, bins> boxes;
      std::array<std::size_t, bins> counts{};
      for (std::size_t k = range.begin; k < range.end; ++k) {
        const Box3& box = boxes_[bvh_.order_[k]];
        const std::size_t bin = bin_of(box.center()[axis], centers, axis);
        boxes[bin] = hull(boxes[bin], box);
        ++counts[bin];
      }
      std::array<double, bins> behind{};  // cost of all bins after this one
      Box3 box;
      std::size_t count = 0;
      for (std::size_t bin = bins - 1; bin > 0; --bin) {
        box = hull(box, boxes[bin]);
        count += counts[bin];
        behind[bin - 1] = box.surface_area() * static_cast<double>(count);
      }
      box = Box3::empty();
      count = 0;
      for (std::size_t bin = 0; bin + 1 < bins; ++bin) {
        box = hull(box, boxes[bin]);
        count += counts[bin];
        const double cost = box.surface_area() * static_cast<double>(count) + behind[bin];
        if (count > 0 && count < range.size() && cost < best.cost) best = {cost, axis, bin};
      }
    }
    return best;
  }

  MeshBvh& bvh_;
  std::vector<Box3> boxes_;
};

MeshBvh::MeshBvh(const TriangleMesh& mesh) : MeshBvh(boxes_of(mesh)) {}

MeshBvh::MeshBvh(std::vector<Box3> boxes) {
  Builder(std::move(boxes), *this).build();
}

Box3 MeshBvh::box_of(const Node& node, std::size_t i) const {
  return {{node.lower[0][i], node.lower[1][i], node.lower[2][i]},
          {node.upper[0][i], node.upper[1][i], node.upper[2][i]}};
}

double MeshBvh::support(const TriangleMesh& mesh, const Vec3& n) const {
  // The largest over a box, the nearest first; what a box cannot better is passed over.
  double best = -Box3::inf;
  const auto over_box = [&n](const Box3& box) {
    const Vec3 low = n * box.lower, high = n * box.upper;
    const double largest = std::max(low.x, high.x) + std::max(low.y, high.y) + std::max(low.z, high.z);
    return std::isnan(largest) ? Box3::inf : largest + gamma(4) * dot(abs(n), max(abs(box.lower), abs(box.upper)));
  };
  struct Entry {
    std::uint32_t node;
    double bound;
  };
  std::array<Entry, stack_size> stack;
  std::size_t top = 0;
  if (!nodes_.empty()) stack[top++] = {0, Box3::inf};
  while (top > 0) {
    const Entry entry = stack[--top];
    if (!(entry.bound > best)) continue;
    const Node& node = nodes_[entry.node];
    const std::size_t first = top;
    for (std::size_t i = 0; i < width; ++i) {
      const Child child = node.children[i];
      if (child.count == 0 && child.first == 0) continue;
      const double bound = over_box(box_of(node, i));
      if (!(bound > best)) continue;
      if (child.count == 0) {
        stack[top++] = {child.first, bound};
        continue;
      }
      for (std::uint32_t k = 0; k < child.count; ++k) {
        for (const Vec3& p : mesh.corners(order_[child.first + k])) best = std::max(best, dot(n, p));
      }
    }
    std::sort(stack.begin() + static_cast<std::ptrdiff_t>(first), stack.begin() + static_cast<std::ptrdiff_t>(top),
              [](const Entry& a, const Entry& b) { return a.bound < b.bound; });
  }
  return best;
}

}  // namespace tenon
