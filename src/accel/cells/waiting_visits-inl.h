// Where each ray of a batch has still to go. Included once for each instruction set.

#if defined(TENON_ACCEL_CELLS_WAITING_VISITS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TENON_ACCEL_CELLS_WAITING_VISITS_INL_H_
#undef TENON_ACCEL_CELLS_WAITING_VISITS_INL_H_
#else
#define TENON_ACCEL_CELLS_WAITING_VISITS_INL_H_
#endif

#include <hwy/highway.h>

#include <array>
#include <span>

#include "accel/cells/node_stack-inl.h"
#include "accel/cells/ray_batch-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tenon::cells {
namespace HWY_NAMESPACE {

/// The nodes and cells that rays of a block are to visit by themselves, for few of the others do: by ray, the nearest
/// last.
class WaitingVisits {
 public:
  void Clear() {
    count_.fill(0);
    rays_ = 0;
    total_ = fullest_ = 0;
  }

  /// Whether there is room for one more of each ray.
  bool has_room() const { return fullest_ < most_begun; }
  std::size_t total() const { return total_; }
  std::uint64_t rays() const { return rays_; }
  std::span<const NodeStack::Visit> of(std::size_t ray) const { return {visits_[ray].data(), count_[ray]}; }

  void Add(std::size_t ray, const NodeStack::Visit& visit) {
    auto& visits = visits_[ray];
    std::size_t place = count_[ray]++;
    for (; place > 0 && visits[place - 1].t_in < visit.t_in; --place) visits[place] = visits[place - 1];
    visits[place] = visit;
    rays_ |= std::uint64_t{1} << ray;
    ++total_;
    fullest_ = std::max<std::size_t>(fullest_, count_[ray]);
  }

 private:
  std::array<std::uint8_t, RayBatch::most_rays> count_;
  std::array<std::array<NodeStack::Visit, most_begun>, RayBatch::most_rays> visits_;
  std::uint64_t rays_;
  std::size_t total_, fullest_;
};

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#endif
