#include "primitive/mesh_bvh.h"

#include <algorithm>
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

// What the difference of two doubles rounds by, and room for taking it off.
double outward(double value) {
  return 0x1p-52 * std::fabs(value);
}

}  // namespace

Box3 MeshBvh::Frame::box_from_outside(const Box3& box) const {
  Box3 inner{scale * (box.lower - center), scale * (box.upper - center)};
  for (int axis = 0; axis < 3; ++axis) {
    inner.lower[axis] -= outward(inner.lower[axis]);
    inner.upper[axis] += outward(inner.upper[axis]);
  }
  return inner;
}

Box3 MeshBvh::Frame::box_to_outside(const Box3& box) const {
  Box3 outer{center + (1 / scale) * box.lower, center + (1 / scale) * box.upper};
  for (int axis = 0; axis < 3; ++axis) {
    outer.lower[axis] -= outward(outer.lower[axis]);
    outer.upper[axis] += outward(outer.upper[axis]);
  }
  return outer;
}

class MeshBvh::Builder {
 public:
  Builder(std::span<const Box3> boxes, MeshBvh& bvh) : bvh_(bvh), boxes_(boxes), order_(boxes.size()) {
    std::iota(order_.begin(), order_.end(), 0);
  }

  void build() {
    if (boxes_.empty()) return;
    Box3 bounds;
    for (const Box3& box : boxes_) bounds = hull(bounds, box);
    bvh_.frame_.center = bounds.center();
    const double reach = max_component(max(bounds.upper - bvh_.frame_.center, bvh_.frame_.center - bounds.lower));
    // A mesh that is a point is fine in any frame.
    bvh_.frame_.scale = reach > 0 ? std::ldexp(1.0, std::clamp(-1 - std::ilogb(reach), -1000, 1000)) : 1;
    add_node({0, boxes_.size()}, 0);
  }

 private:
  struct Range {
    std::size_t begin, end;
    std::size_t size() const { return end - begin; }
  };
  struct Part {
    Range range;
    Box3 box;
  };

  Part part_of(const Range& range) const {
    Part part{range, {}};
    for (std::size_t k = range.begin; k < range.end; ++k) part.box = hull(part.box, boxes_[order_[k]]);
    return part;
  }

  // The part to be opened: of those that are no leaf the one that most lines meet.
  Part* largest_part(std::span<Part> parts) const {
    Part* largest = nullptr;
    for (Part& part : parts) {
      if (part.range.size() <= bvh_.leaf_size_) continue;
      if (largest == nullptr || part.box.surface_area() > largest->box.surface_area()) largest = &part;
    }
    return largest;
  }

  std::uint32_t add_node(const Range& range, int depth) {
    const std::size_t index = bvh_.nodes_.size();
    bvh_.nodes_.emplace_back();
    std::array<Part, width> parts{part_of(range)};
    std::size_t count = 1;
    while (count < width) {
      Part* const opened = largest_part({parts.data(), count});
      if (opened == nullptr) break;
      const Range whole = opened->range;
      const std::size_t middle = split(whole, depth);
      *opened = part_of({whole.begin, middle});
      parts[count++] = part_of({middle, whole.end});
    }
    for (std::size_t i = 0; i < width; ++i) {
      Box3 box;
      Child child;
      if (i < count) {
        box = bvh_.frame_.box_from_outside(parts[i].box);
        const Range& own = parts[i].range;
        child =
            own.size() <= bvh_.leaf_size_ ? Child{add_leaf(own) | Child::leaf_bit} : Child{add_node(own, depth + 1)};
      }
      Node& node = bvh_.nodes_[index];
      node.children[i] = child;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        node.ends[axis][0][i] = below(box.lower[static_cast<int>(axis)]);
        node.ends[axis][1][i] = above(box.upper[static_cast<int>(axis)]);
      }
    }
    return static_cast<std::uint32_t>(index);
  }

  std::uint32_t add_leaf(const Range& range) {
    const std::size_t place = bvh_.order_.size();
    bvh_.order_.resize(place + bvh_.leaf_size_, none);
    std::copy(order_.begin() + static_cast<std::ptrdiff_t>(range.begin),
              order_.begin() + static_cast<std::ptrdiff_t>(range.end),
              bvh_.order_.begin() + static_cast<std::ptrdiff_t>(place));
    return static_cast<std::uint32_t>(place / bvh_.leaf_size_);
  }

  // Reorders a range into two parts, none of them empty.
  // @return where the second begins
  std::size_t split(const Range& range, int depth) {
    Box3 centers;
    for (std::size_t k = range.begin; k < range.end; ++k) centers = hull(centers, boxes_[order_[k]].center());
    const Vec3 size = centers.size();
    const std::size_t half = range.begin + range.size() / 2;
    const Cut cut = depth < deepest_by_cost ? best_cut(range, centers) : Cut{};
    const auto begin = order_.begin();
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
        const Box3& box = boxes_[order_[k]];
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
  std::span<const Box3> boxes_;
  std::vector<std::uint32_t> order_;
};

MeshBvh::MeshBvh(const TriangleMesh& mesh) : leaf_size_(width) {
  Builder(boxes_of(mesh), *this).build();
  fill_blocks(mesh);
}

// Who meets a box has a solid to be met within it, which costs more than a node.
MeshBvh::MeshBvh(std::span<const Box3> boxes) {
  Builder(boxes, *this).build();
}

void MeshBvh::fill_blocks(const TriangleMesh& mesh) {
  blocks_.resize(order_.size() / width);
  for (std::size_t k = 0; k < order_.size(); ++k) {
    if (order_[k] == none) continue;
    const std::array<Vec3, 3> corners = mesh.corners(order_[k]);
    for (std::size_t corner = 0; corner < 3; ++corner) {
      const Vec3 p = frame_.scale * (corners[corner] - frame_.center);
      auto& axes = blocks_[k / width].corners[corner];
      for (std::size_t axis = 0; axis < 3; ++axis)
        axes[axis][k % width] = static_cast<float>(p[static_cast<int>(axis)]);
    }
  }
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
      if (child.is_none()) continue;
      const double bound = over_box(frame_.box_to_outside(box_of(node, i)));
      if (!(bound > best)) continue;
      if (!child.is_leaf()) {
        stack[top++] = {child.index(), bound};
        continue;
      }
      for (const std::uint32_t triangle : leaf(child.index())) {
        if (triangle == none) continue;
        for (const Vec3& p : mesh.corners(triangle)) best = std::max(best, dot(n, p));
      }
    }
    std::sort(stack.begin() + static_cast<std::ptrdiff_t>(first), stack.begin() + static_cast<std::ptrdiff_t>(top),
              [](const Entry& a, const Entry& b) { return a.bound < b.bound; });
  }
  return best;
}

}  // namespace tenon
