// What was found of each ray of a batch. Included once for each instruction set.

#if defined(TENON_ACCEL_CELLS_BATCH_FINDINGS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TENON_ACCEL_CELLS_BATCH_FINDINGS_INL_H_
#undef TENON_ACCEL_CELLS_BATCH_FINDINGS_INL_H_
#else
#define TENON_ACCEL_CELLS_BATCH_FINDINGS_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>

#include "accel/cells/ray_batch-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tenon::cells {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// What plain arithmetic has found of the rays of a batch.
struct BatchFindings {
  static constexpr std::size_t most_rays = RayBatch::most_rays;
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  enum Flag : std::uint8_t { entering = 1, group = 2 };

  HWY_ALIGN double t[most_rays];  ///< of the first boundary so far, counted from the start
  std::uint32_t cell[most_rays];  ///< or `none`
  LeafId leaf[most_rays];
  std::uint8_t flags[most_rays];   ///< of Flag
  std::uint8_t values[most_rays];  ///< of the cell's points before the boundary and, four bits up, behind it
  std::uint64_t unsure = 0;        ///< rays that are left to SingleTracer

  /// A boundary, as the above say it.
  struct Boundary {
    double t;
    std::uint32_t cell;
    LeafId leaf;
    std::uint8_t flags, values;
  };

  void Clear(const RayBatch& rays) {
    const RayBatch::D d;
    for (std::size_t i = 0; i < rays.padded; i += RayBatch::double_lanes)
      hn::Store(hn::Set(d, std::numeric_limits<double>::infinity()), d, &t[i]);
    std::fill_n(cell, rays.padded, none);
    unsure = rays.unsound;
  }

  /// The rays that have a boundary, a bit each. @param padded  of the batch
  std::uint64_t Met(std::size_t padded) const {
    const hn::Rebind<std::uint32_t, RayBatch::F> u;
    std::uint64_t met = 0;
    for (std::size_t i = 0; i < padded; i += RayBatch::float_lanes) {
      std::uint8_t bits[8] = {};
      hn::StoreMaskBits(u, hn::Ne(hn::LoadU(u, &cell[i]), hn::Set(u, none)), bits);
      met |= static_cast<std::uint64_t>(bits[0] | bits[1] << 8) << i;
    }
    return met;
  }

  /// Keeps a boundary unless a nearer one is known: nothing behind it counts from now on.
  /// @param any_will_do  whether one that certainly lies before the ray's end makes an end of it
  HWY_INLINE void Keep(RayBatch& rays, std::size_t i, const Boundary& boundary, bool any_will_do) {
    if (!(boundary.t < t[i])) return;
    t[i] = boundary.t;
    cell[i] = boundary.cell;
    leaf[i] = boundary.leaf;
    flags[i] = boundary.flags;
    values[i] = boundary.values;
    // Rounded up, for cells whose boxes overlap by the slack.
    const bool is_done = any_will_do && boundary.t + rays.start[i] + 2 * rays.near[i] < rays.end[i];
    rays.box_end[i] = is_done ? -1 : std::min(rays.box_end[i], static_cast<float>(boundary.t * (1 + 0x1p-20)));
  }

  /// Has a ray traced no further, but by SingleTracer.
  void Drop(RayBatch& rays, std::size_t i) {
    unsure |= std::uint64_t{1} << i;
    rays.box_end[i] = -1;
  }

  static constexpr std::uint8_t flags_of(bool enters, bool crowded) {
    return static_cast<std::uint8_t>((enters ? entering : 0) | (crowded ? group : 0));
  }
  static constexpr std::uint8_t values_of(std::uint64_t before, std::uint64_t after) {
    return static_cast<std::uint8_t>(before | after << 4);
  }

  void TakeValues(std::size_t ray, CellAnswer& answer) const {
    answer.before = values[ray] & 15;
    answer.after = values[ray] >> 4;
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#endif
