#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "primitive/mesh_bvh.h"

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

// A place, or what is like one.
struct Vec3f {
  std::array<float, 3> at;

  static Vec3f all(float value) { return {{value, value, value}}; }
  void raise_to(const Vec3f& other) {
    for (std::size_t i = 0; i < 3; ++i) at[i] = at[i] > other.at[i] ? at[i] : other.at[i];
  }
};

// A box in the hierarchy's frame; empty at first.
struct FrameBox {
  static constexpr float inf = std::numeric_limits<float>::infinity();
  Vec3f minus_lower = Vec3f::all(-inf), upper = Vec3f::all(-inf);

  void take(const FrameBox& other) {
    minus_lower.raise_to(other.minus_lower);
    upper.raise_to(other.upper);
  }
  float lower(std::size_t axis) const { return -minus_lower.at[axis]; }
  float size(std::size_t axis) const { return upper.at[axis] + minus_lower.at[axis]; }
  float surface_area() const {
    return is_empty() ? 0 : 2 * (size(0) * size(1) + size(1) * size(2) + size(2) * size(0));
  }
  bool is_empty() const { return !(size(0) >= 0); }
};

}  // namespace

class MeshBvh::Builder {
 public:
  Builder(std::span<const Box3> boxes, MeshBvh& bvh) : bvh_(bvh) {
    if (boxes.empty()) return;
    Box3 bounds;
    for (const Box3& box : boxes) bounds = hull(bounds, box);
    bvh_.frame_.center = bounds.center();
    const double reach = max_component(max(bounds.upper - bvh_.frame_.center, bvh_.frame_.center - bounds.lower));
    // A mesh that is a point is fine in any frame.
    bvh_.frame_.scale = reach > 0 ? std::ldexp(1.0, std::clamp(-1 - std::ilogb(reach), -1000, 1000)) : 1;
    items_.reserve(boxes.size());
    for (const Box3& box : boxes) items_.push_back(item_of(box, static_cast<std::uint32_t>(items_.size())));
  }

  void build() {
    if (!items_.empty()) add_node({0, items_.size()}, 0);
  }

 private:
  // What is split together stands side by side.
  struct Item {
    FrameBox box;
    Vec3f center;
    std::uint32_t triangle;
  };
  struct Range {
    std::size_t begin, end;
    std::size_t size() const { return end - begin; }
  };
  struct Part {
    Range range;
    FrameBox box;
  };

  Item item_of(const Box3& box, std::uint32_t triangle) const {
    const Box3 inner = bvh_.frame_.box_from_outside(box);
    Item item{{}, Vec3f::all(0), triangle};
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int a = static_cast<int>(axis);
      item.box.minus_lower.at[axis] = -below(inner.lower[a]);
      item.box.upper.at[axis] = above(inner.upper[a]);
      item.center.at[axis] = 0.5f * item.box.lower(axis) + 0.5f * item.box.upper.at[axis];
    }
    return item;
  }

  std::span<const Item> items(const Range& range) const { return {items_.data() + range.begin, range.size()}; }

  Part part_of(const Range& range) const {
    Part part{range, {}};
    for (const Item& item : items(range)) part.box.take(item.box);
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
      FrameBox box;
      Child child;
      if (i < count) {
        box = parts[i].box;
        const Range& own = parts[i].range;
        child =
            own.size() <= bvh_.leaf_size_ ? Child{add_leaf(own) | Child::leaf_bit} : Child{add_node(own, depth + 1)};
      }
      Node& node = bvh_.nodes_[index];
      node.children[i] = child;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        node.ends[axis][0][i] = box.lower(axis);
        node.ends[axis][1][i] = box.upper.at[axis];
      }
    }
    return static_cast<std::uint32_t>(index);
  }

  std::uint32_t add_leaf(const Range& range) {
    const std::size_t place = bvh_.order_.size();
    bvh_.order_.resize(place + bvh_.leaf_size_, none);
    const auto own = items(range);
    std::transform(own.begin(), own.end(), bvh_.order_.begin() + static_cast<std::ptrdiff_t>(place),
                   [](const Item& item) { return item.triangle; });
    return static_cast<std::uint32_t>(place / bvh_.leaf_size_);
  }

  // Reorders a range into two parts, none of them empty.
  // @return where the second begins
  std::size_t split(const Range& range, int depth) {
    FrameBox centers;
    for (const Item& item : items(range)) {
      centers.upper.raise_to(item.center);
      for (std::size_t i = 0; i < 3; ++i) {
        centers.minus_lower.at[i] = std::max(centers.minus_lower.at[i], -item.center.at[i]);
      }
    }
    const std::size_t half = range.begin + range.size() / 2;
    const Bins by(centers);
    const Cut cut = depth < deepest_by_cost ? best_cut(range, by) : Cut{};
    const auto begin = items_.begin();
    const auto at = [begin](std::size_t i) { return begin + static_cast<std::ptrdiff_t>(i); };
    if (cut.cost < Box3::inf) {
      const auto middle = std::partition(at(range.begin), at(range.end),
                                         [&](const Item& item) { return by.bins_of(item)[cut.axis] <= cut.last_bin; });
      return static_cast<std::size_t>(middle - begin);
    }
    std::size_t longest = 0;
    for (std::size_t axis = 1; axis < 3; ++axis) {
      if (centers.size(axis) > centers.size(longest)) longest = axis;
    }
    std::nth_element(at(range.begin), at(half), at(range.end), [&](const Item& a, const Item& b) {
      const float ca = a.center.at[longest], cb = b.center.at[longest];
      return ca != cb ? ca < cb : a.triangle < b.triangle;
    });
    return half;
  }

  static constexpr std::size_t bins = 16;
  struct Cut {
    double cost = Box3::inf;
    std::size_t axis = 0;
    std::int32_t last_bin = 0;  // of the first part
  };

  // The bins of centers, by axis; all in the first one along an axis on which they do not differ.
  class Bins {
   public:
    explicit Bins(const FrameBox& centers) : minus_lower_(centers.minus_lower), per_unit_(Vec3f::all(0)) {
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const float rate = static_cast<float>(bins) / centers.size(axis);
        if (std::isfinite(rate)) per_unit_.at[axis] = rate;
      }
    }
    bool tells(std::size_t axis) const { return per_unit_.at[axis] > 0; }
    std::array<std::int32_t, 3> bins_of(const Item& item) const {
      constexpr auto last = static_cast<std::int32_t>(bins - 1);
      std::array<std::int32_t, 3> result;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const float share = (item.center.at[axis] + minus_lower_.at[axis]) * per_unit_.at[axis];
        result[axis] = share > 0 ? std::min(static_cast<std::int32_t>(share), last) : 0;
      }
      return result;
    }

   private:
    Vec3f minus_lower_, per_unit_;
  };

  struct Bin {
    FrameBox box;
    std::size_t count = 0;

    void take(const Bin& other) {
      box.take(other.box);
      count += other.count;
    }
    double cost() const { return static_cast<double>(box.surface_area()) * static_cast<double>(count); }
  };

  Cut best_cut(const Range& range, const Bins& by) const {
    std::array<std::array<Bin, bins>, 3> binned;
    for (const Item& item : items(range)) {
      const auto own = by.bins_of(item);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        Bin& bin = binned[axis][static_cast<std::size_t>(own[axis])];
        bin.box.take(item.box);
        ++bin.count;
      }
    }
    Cut best;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (!by.tells(axis)) continue;
      std::array<double, bins> behind{};  // cost of all bins after this one
      Bin part;
      for (std::size_t bin = bins - 1; bin > 0; --bin) {
        part.take(binned[axis][bin]);
        behind[bin - 1] = part.cost();
      }
      part = {};
      for (std::size_t bin = 0; bin + 1 < bins; ++bin) {
        part.take(binned[axis][bin]);
        const double cost = part.cost() + behind[bin];
        if (part.count > 0 && part.count < range.size() && cost < best.cost)
          best = {cost, axis, static_cast<std::int32_t>(bin)};
      }
    }
    return best;
  }

  MeshBvh& bvh_;
  std::vector<Item> items_;
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

}  // namespace tenon
