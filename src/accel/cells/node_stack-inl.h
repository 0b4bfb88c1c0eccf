// What is left of the tree for one ray. Included once for each instruction set.

#if defined(TENON_ACCEL_CELLS_NODE_STACK_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TENON_ACCEL_CELLS_NODE_STACK_INL_H_
#undef TENON_ACCEL_CELLS_NODE_STACK_INL_H_
#else
#define TENON_ACCEL_CELLS_NODE_STACK_INL_H_
#endif

#include <hwy/highway.h>

#include <array>
#include <bit>

#include "accel/cells/lanes-inl.h"
#include "accel/cells/wide_node.h"

HWY_BEFORE_NAMESPACE();
namespace tenon::cells {
namespace HWY_NAMESPACE {

/// A node has at most eight children in place of itself, and no tree is deeper; a ray begins with so many at most.
inline constexpr std::size_t most_depth = 64;
inline constexpr std::size_t most_begun = 8;
inline constexpr std::size_t most_pending = most_depth * (node_width - 1) + most_begun + 1;

/// By mask: the numbers of the bits that are set, three bits each, and then those of the others.
inline constexpr std::array<std::uint32_t, 1 << node_width> set_bits_first = [] {
  std::array<std::uint32_t, 1 << node_width> all{};
  for (std::uint32_t mask = 0; mask < all.size(); ++mask) {
    int place = 0;
    for (const std::uint32_t wanted : {1U, 0U}) {
      for (std::uint32_t bit = 0; bit < node_width; ++bit) {
        if ((mask >> bit & 1) == wanted) all[mask] |= bit << (3 * place++);
      }
    }
  }
  return all;
}();

/// A ray in single precision, from where it meets the scene, as many times as a node has children: it meets a plane at
/// t = plane * inverse - shift.
struct BoxRay {
  using Wide = hn::CappedTag<float, node_width>;

  hn::Vec<Wide> shift[3], inverse[3];
  hn::Vec<Wide> end;
  std::uint32_t octant;  ///< bit a: backward along axis a

  BoxRay() = default;
  HWY_INLINE BoxRay(const float* its_shift, const float* its_inverse, float t_end, std::uint32_t its_octant)
      : end(hn::Set(Wide(), t_end)), octant(its_octant) {
    for (std::size_t a = 0; a < 3; ++a) {
      shift[a] = hn::Set(Wide(), its_shift[a]);
      inverse[a] = hn::Set(Wide(), its_inverse[a]);
    }
  }
};

/// Nodes and cells that a ray has still to visit, the nearest last.
class NodeStack {
 public:
  struct Visit {
    ChildRef child;
    float t_in, t_out;
  };

  bool empty() const { return size_ == 0; }
  void Clear() { size_ = 0; }
  Visit Pop() {
    --size_;
    return {ChildRef{child_[size_]}, t_in_[size_], t_out_[size_]};
  }
  void Push(const Visit& visit) {
    child_[size_] = visit.child.bits;
    t_in_[size_] = visit.t_in;
    t_out_[size_++] = visit.t_out;
  }
  /// Pushes the children that the ray meets.
  HWY_INLINE void Open(const WideNode& node, const BoxRay& ray) {
    Opened opened;
    Push(node, ray, opened);
  }

  /// The same, but that the nearest is taken off again. It is had sooner than by Pop(), which reads what was hardly
  /// written.
  /// @return whether there is one
  HWY_INLINE bool OpenNearest(const WideNode& node, const BoxRay& ray, Visit& nearest) {
    Opened opened;
    Push(node, ray, opened);
    if (opened.met == 0) return false;
    --size_;
    const auto place = static_cast<std::uint32_t>(std::bit_width(opened.met) - 1);
    nearest.child = node.children[node.last_to_first[ray.octant] >> (3 * place) & 7];
    nearest.t_in = opened.near[place];
    nearest.t_out = opened.far[place];
    return true;
  }

 private:
  using Wide = BoxRay::Wide;
  struct Stretches {
    hn::Vec<Wide> near, far;
  };

  static HWY_INLINE Stretches Meet(const WideNode& node, const BoxRay& ray, std::size_t lane) {
    hn::Vec<Wide> near[3], far[3];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float* ends = node.ends[axis][0].data() + lane;
      const std::size_t first = (ray.octant >> axis & 1) * node_width;
      near[axis] = hn::MulSub(hn::Load(Wide(), ends + first), ray.inverse[axis], ray.shift[axis]);
      far[axis] = hn::MulSub(hn::Load(Wide(), ends + (node_width - first)), ray.inverse[axis], ray.shift[axis]);
    }
    return {hn::Max(hn::Max(near[0], near[1]), hn::Max(near[2], hn::Zero(Wide()))),
            hn::Min(hn::Min(far[0], far[1]), hn::Min(far[2], ray.end))};
  }

  // What the ray meets of a node, from last to first; of those that are not met, anything.
  struct Opened {
    HWY_ALIGN float near[node_width];
    HWY_ALIGN float far[node_width];
    std::uint32_t met;  // a bit each
  };

  // Lanes in an order, three bits each, as WideNode::last_to_first has it.
  template <class Lanes>
  static HWY_INLINE hn::Vec<Lanes> Arranged(Lanes d, hn::Vec<Lanes> v, std::uint32_t order) {
    const hn::RebindToUnsigned<Lanes> u;
    HWY_ALIGN static constexpr std::uint32_t shifts[node_width] = {0, 3, 6, 9, 12, 15, 18, 21};
    const auto lanes = hn::And(hn::Shr(hn::Set(u, order), hn::Load(u, shifts)), hn::Set(u, 7));
    return hn::TableLookupLanes(v, hn::IndicesFromVec(d, lanes));
  }

  // The lanes of a mask first. Highway's Compress for AVX2 has a table of 1 KiB copied to the stack each time (1.0.3,
  // by GCC), which takes longer than all the rest here.
  template <class Lanes>
  static HWY_INLINE hn::Vec<Lanes> Compressed(Lanes d, hn::Vec<Lanes> v, hn::Mask<Lanes> mask, std::uint32_t bits) {
#if HWY_TARGET == HWY_AVX2
    static_cast<void>(mask);
    return Arranged(d, v, set_bits_first[bits]);
#else
    static_cast<void>(d);
    static_cast<void>(bits);
    return hn::Compress(v, mask);
#endif
  }

  HWY_INLINE void Push(const WideNode& node, const BoxRay& ray, Opened& opened) {
    const Wide wide;
    const std::uint32_t order = node.last_to_first[ray.octant];
    const std::size_t size = size_;
    if constexpr (hn::MaxLanes(Wide()) == node_width) {
      const hn::RebindToUnsigned<Wide> whole;
      const Stretches s = Meet(node, ray, 0);
      const auto near = Arranged(wide, s.near, order), far = Arranged(wide, s.far, order);
      const auto child = Arranged(whole, hn::Load(whole, &node.children[0].bits), order);
      const auto met = hn::Le(near, far);
      hn::Store(near, wide, opened.near);
      hn::Store(far, wide, opened.far);
      std::uint8_t bits[8] = {};
      hn::StoreMaskBits(wide, met, bits);
      opened.met = bits[0];
      // Whole vectors are written; what lies behind the last one met is overwritten by what comes next.
      hn::StoreU(Compressed(wide, near, met, opened.met), wide, t_in_ + size);
      hn::StoreU(Compressed(wide, far, met, opened.met), wide, t_out_ + size);
      hn::StoreU(Compressed(whole, child, hn::RebindMask(whole, met), opened.met), whole, child_ + size);
      size_ = size + hn::CountTrue(wide, met);
    } else {
      HWY_ALIGN float near[node_width];
      HWY_ALIGN float far[node_width];
      for (std::size_t lane = 0; lane < node_width; lane += hn::Lanes(wide)) {
        const Stretches s = Meet(node, ray, lane);
        hn::Store(s.near, wide, near + lane);
        hn::Store(s.far, wide, far + lane);
      }
      opened.met = 0;
      for (std::uint32_t place = 0; place < node_width; ++place) {
        const std::uint32_t lane = order >> (3 * place) & 7;
        opened.near[place] = near[lane];
        opened.far[place] = far[lane];
        const std::uint32_t met = near[lane] <= far[lane] ? 1 : 0;
        opened.met |= met << place;
        child_[size_] = node.children[lane].bits;
        t_in_[size_] = near[lane];
        t_out_[size_] = far[lane];
        size_ += met;
      }
    }
  }

  // From the beginning of a cache line on: the first few stores, which are most of them, lie within one, and what lies
  // across two is slow to read soon after.
  alignas(64) std::uint32_t child_[most_pending + node_width];
  alignas(64) float t_in_[most_pending + node_width];
  alignas(64) float t_out_[most_pending + node_width];
  std::size_t size_ = 0;
};

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#endif
