// Lines that stand for others. Included once for each instruction set.

#if defined(TENON_PRIMITIVE_MESH_LINE_BUNDLE_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TENON_PRIMITIVE_MESH_LINE_BUNDLE_INL_H_
#undef TENON_PRIMITIVE_MESH_LINE_BUNDLE_INL_H_
#else
#define TENON_PRIMITIVE_MESH_LINE_BUNDLE_INL_H_
#endif

#include <hwy/highway.h>

#include <limits>

#include "primitive/mesh_line-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tenon {
namespace HWY_NAMESPACE {

/// The least and the greatest of some numbers.
class NumberRange {
 public:
  HWY_INLINE NumberRange() : least_(infinity), greatest_(-infinity) {}
  HWY_INLINE void Include(LaneConditions where, LaneNumbers x) {
    least_ = smaller(least_, choose(where, x, LaneNumbers(infinity)));
    greatest_ = larger(greatest_, choose(where, x, LaneNumbers(-infinity)));
  }
  HWY_INLINE double low() const { return hn::GetLane(hn::MinOfLanes(LaneNumbers::D(), least_.v)); }
  HWY_INLINE double high() const { return hn::GetLane(hn::MaxOfLanes(LaneNumbers::D(), greatest_.v)); }
  HWY_INLINE double middle() const { return 0.5 * low() + 0.5 * high(); }

 private:
  static constexpr double infinity = std::numeric_limits<double>::infinity();

  LaneNumbers least_, greatest_;
};

/// Lines as one, within whose errors they all lie: first all are included, then the middle is found, and then all are
/// included once more, with what each may be wrong by.
class LineBundle {
 public:
  HWY_INLINE LineBundle() {}
  HWY_INLINE void Include(LaneConditions where, const FramedLine<LaneNumbers>& line) {
    for (std::size_t i = 0; i < 2; ++i) {
      starts_[i].Include(where, line.start[i]);
      slopes_[i].Include(where, line.slope[i]);
    }
  }
  HWY_INLINE void FindMiddle() {
    for (std::size_t i = 0; i < 2; ++i) {
      start_[i] = starts_[i].middle();
      slope_[i] = slopes_[i].middle();
    }
  }
  /// @param up  of the line that has the largest
  HWY_INLINE void IncludeErrors(LaneConditions where, const FramedLine<LaneNumbers>& line, double up) {
    for (std::size_t i = 0; i < 2; ++i) {
      // A mesh lies within 1 of the middle of its frame.
      const LaneNumbers apart =
          magnitude(line.start[i] - start_[i]) + LaneNumbers(1 + up) * magnitude(line.slope[i] - slope_[i]);
      growths_[i].Include(where, line.growth[i] + apart);
      errors_[i].Include(where, line.error[i] + apart);
    }
  }

  /// The line, with what single precision makes of it. How far those that it stands for have come is its t.
  HWY_INLINE FramedLine<double> line(double up) const {
    FramedLine<double> line;
    line.up = up;
    line.come_at_0 = 0;
    line.speed = 1;
    line.is_beside = false;
    for (std::size_t i = 0; i < 2; ++i) {
      line.start[i] = start_[i];
      line.slope[i] = slope_[i];
      line.growth[i] = growths_[i].high() + RoundingAtPlanes(up);
      line.error[i] = errors_[i].high() + RoundingAtPlanes(up);
    }
    return line;
  }

 private:
  NumberRange starts_[2], slopes_[2], growths_[2], errors_[2];
  double start_[2], slope_[2];
};

}  // namespace HWY_NAMESPACE
}  // namespace tenon
HWY_AFTER_NAMESPACE();

#endif
