// The hierarchy of Bouatouch's course, "Hierarchy: median cut method": objects are sorted along the widest slab and
// split into halves, recursively; the nodes lie in an array, the children of node i at 2i and 2i + 1.
//
// Where the course leaves something open:
//   * Objects are the minimum enclosures of the leaves, and `slabs` cuts them by each leaf's own slabs. The slabs that
//     are compared are those of the volumes: `normals` of them with volume=slabs, else those along the axes.
//   * The list is cut at its middle, the first half getting the odd one. Sorting is by dmin, as in the course, then by
//     tree order; only the cut has to be in place, so a selection does instead of quicksort.
//   * A leaf holds up to `leaf` objects (the course's Max_obj), each with its own volume where it holds several.
//   * volume=box|sphere|ellipsoid|slabs. `filter=on` asks, before a volume, for primary rays the rectangle it projects
//     to on the screen (when the structure is built for a view) and for the others a sphere around it.
//   * The course says that nodes are searched from the root to the leaves. They are opened nearest entry first, so that
//     a ray may stop early.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <numeric>
#include <optional>
#include <vector>

#include "accel/all.h"
#include "accel/bounding_volumes.h"
#include "accel/nearest_first.h"
#include "accel/screen_rectangles.h"
#include "accel/structure.h"

namespace tenon {

namespace {

struct MedianOptions {
  std::size_t leaf_size = 1;
  bool filter = false;
};

template <BoundingVolumes Volumes>
class MedianBvh {
 public:
  struct Scratch {
    EntryQueue queue;
  };

  MedianBvh(const BuildInput& input, const VolumeInput& objects, const MedianOptions& options) {
    const std::size_t count = objects.leaves.size();
    if (count == 0) return;
    order_.resize(count);
    std::iota(order_.begin(), order_.end(), 0u);
    // Halving n objects until at most leaf_size are left in the larger half takes this many levels.
    for (std::size_t larger = count; larger > options.leaf_size; larger = (larger + 1) / 2) ++levels_;
    nodes_.resize(std::size_t{2} << levels_);
    cut(objects, options.leaf_size);

    const std::size_t volumes = nodes_.size() + (options.leaf_size > 1 ? count : 0);
    volumes_.emplace(volumes, objects);
    if (options.filter) {
      spheres_.emplace(volumes, objects);
      if (input.view != nullptr) rectangles_.emplace(*input.view, volumes, enclosure_margin(input.tree));
    }
    for (std::size_t i = 1; i < nodes_.size(); ++i) set_volume(i, objects, members(nodes_[i]));
    for (std::size_t i = nodes_.size(); i < volumes; ++i) {
      set_volume(i, objects, std::span(order_).subspan(i - nodes_.size(), 1));
    }
    for (const std::uint32_t i : order_) leaves_.push_back(objects.leaves[i].leaf);
    order_ = {};
  }

  void traverse(Walk& walk, Scratch& scratch) const {
    if (nodes_.empty()) return;
    const PreparedRays rays{volumes_->prepare(walk.ray()), EllipsoidVolumes::prepare(walk.ray())};
    EntryQueue& queue = scratch.queue;
    queue.clear();
    const auto push = [&](std::uint32_t i) {
      const BoxSpan span = enter(walk, rays, i);
      if (!span.empty()) queue.push(span.t_in, i);
    };
    push(1);
    nearest_first(walk, queue, [&](std::uint32_t i) {
      const Node& node = nodes_[i];
      if (!node.leaf) {
        push(2 * i);
        push(2 * i + 1);
        return;
      }
      for (std::uint32_t k = node.begin; k < node.end; ++k) {
        if (node.end - node.begin > 1 && enter(walk, rays, nodes_.size() + k).empty()) continue;
        walk.reveal(leaves_[k]);
      }
    });
  }

  std::size_t memory_bytes() const {
    return nodes_.size() * sizeof(Node) + leaves_.size() * sizeof(LeafId) + (volumes_ ? volumes_->bytes() : 0) +
           (spheres_ ? spheres_->bytes() : 0) + (rectangles_ ? rectangles_->bytes() : 0);
  }
  std::size_t boxes() const {
    return static_cast<std::size_t>(
        std::count_if(nodes_.begin(), nodes_.end(), [](const Node& n) { return n.used(); }));
  }
  int depth() const { return nodes_.empty() ? 0 : levels_ + 1; }

 private:
  struct Node {
    std::uint32_t begin = 0, end = 0;  // into leaves_; nothing: the place in the array is not used
    bool leaf = false;
    bool used() const { return begin < end; }
  };
  struct PreparedRays {
    typename Volumes::PreparedRay volume;
    EllipsoidVolumes::PreparedRay sphere;
  };

  // Cuts each node's list in two, parents before children.
  void cut(const VolumeInput& objects, std::size_t leaf_size) {
    nodes_[1] = {0, static_cast<std::uint32_t>(order_.size()), false};
    for (std::size_t i = 1; i < nodes_.size(); ++i) {
      Node& node = nodes_[i];
      if (!node.used()) continue;
      const std::uint32_t size = node.end - node.begin;
      node.leaf = size <= leaf_size;
      if (node.leaf) continue;
      const std::uint32_t middle = node.begin + (size + 1) / 2;
      const std::size_t widest = widest_slab(objects.slabs, members(node));
      const auto by_low = [&](std::uint32_t a, std::uint32_t b) {
        const double low_a = objects.slabs.at(a, widest).low, low_b = objects.slabs.at(b, widest).low;
        return low_a != low_b ? low_a < low_b : a < b;
      };
      std::nth_element(order_.begin() + node.begin, order_.begin() + middle, order_.begin() + node.end, by_low);
      nodes_[2 * i] = {node.begin, middle, false};
      nodes_[2 * i + 1] = {middle, node.end, false};
    }
  }

  static std::size_t widest_slab(const LeafSlabs& slabs, std::span<const std::uint32_t> members) {
    std::size_t widest = 0;
    double width = -1;
    for (std::size_t n = 0; n < slabs.normals(); ++n) {
      Slab all = slabs.at(members.front(), n);
      for (const std::uint32_t i : members) {
        all = {std::min(all.low, slabs.at(i, n).low), std::max(all.high, slabs.at(i, n).high)};
      }
      if (all.high - all.low > width) {
        width = all.high - all.low;
        widest = n;
      }
    }
    return widest;
  }

  std::span<const std::uint32_t> members(const Node& node) const {
    return std::span(order_).subspan(node.begin, node.end - node.begin);
  }

  void set_volume(std::size_t index, const VolumeInput& objects, std::span<const std::uint32_t> inside) {
    if (inside.empty()) return;
    volumes_->set(index, objects, inside);
    if (spheres_) spheres_->set(index, objects, inside);
    if (rectangles_) rectangles_->set(index, objects.hull_of(inside));
  }

  // The stretch of the ray in a volume, the filter asked first.
  BoxSpan enter(const Walk& walk, const PreparedRays& rays, std::size_t index) const {
    const RayQuery& query = walk.query();
    if (query.kind == RayKind::primary) {
      if (rectangles_ && !rectangles_->covers(index, query.pixel_x, query.pixel_y)) return {1, 0};
    } else if (spheres_ && spheres_->span(rays.sphere, index).empty()) {
      return {1, 0};
    }
    return volumes_->span(rays.volume, index);
  }

  std::vector<Node> nodes_;           // nodes_[1] is the root
  std::vector<std::uint32_t> order_;  // while building: the objects, node by node
  std::vector<LeafId> leaves_;        // the same as leaves
  int levels_ = 0;
  // By node, then by object where leaves hold several.
  std::optional<Volumes> volumes_;
  std::optional<SphereVolumes> spheres_;
  std::optional<ScreenRectangles> rectangles_;
};

template <class Volumes>
std::unique_ptr<Accelerator> make(const BuildInput& input, const VolumeInput& objects, const MedianOptions& options) {
  using Bvh = MedianBvh<Volumes>;
  return std::make_unique<StructureAccelerator<Bvh>>(input.tree, Bvh(input, objects, options));
}

}  // namespace

Result<std::unique_ptr<Accelerator>> build_median_bvh(const BuildInput& input, AcceleratorOptions& options) {
  MedianOptions chosen;
  const std::size_t volume = options.take_word("volume", {"box", "sphere", "ellipsoid", "slabs"});
  const bool slabs = volume == 3;
  const int normals = options.take_integer("normals", slabs ? 7 : 3, 3, slabs ? most_slab_normals : 3);
  chosen.leaf_size = static_cast<std::size_t>(options.take_integer("leaf", 1, 1, 1 << 20));
  chosen.filter = options.take_switch("filter", false);
  if (Status status = options.finish(); !status) return status.error();

  const std::vector<EnclosedLeaf> leaves = enclosed_leaves(input.tree);
  const LeafSlabs leaf_slabs(input.tree, leaves, static_cast<std::size_t>(normals));
  const VolumeInput objects{leaves, leaf_slabs};
  switch (volume) {
    case 1:
      return make<SphereVolumes>(input, objects, chosen);
    case 2:
      return make<StretchedVolumes>(input, objects, chosen);
    case 3:
      return make<SlabVolumes>(input, objects, chosen);
    default:
      return make<BoxVolumes>(input, objects, chosen);
  }
}

}  // namespace tenon
