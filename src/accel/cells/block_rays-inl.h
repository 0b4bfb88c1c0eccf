// Many rays that go much the same way, side by side. Included once for each instruction set.

#if defined(TENON_ACCEL_CELLS_BLOCK_RAYS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TENON_ACCEL_CELLS_BLOCK_RAYS_INL_H_
#undef TENON_ACCEL_CELLS_BLOCK_RAYS_INL_H_
#else
#define TENON_ACCEL_CELLS_BLOCK_RAYS_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <limits>

#include "accel/cells/cell_trace.h"
#include "accel/cells/scene_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tenon::cells {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Up to 64 rays into one octant, and intervals that hold their origins and directions.
struct BlockRays {
  using D = hn::CappedTag<double, 8>;
  using F = hn::CappedTag<float, 16>;
  // As many floats as there are doubles in a vector.
  using HalfF = hn::Rebind<float, D>;
  static constexpr std::size_t double_lanes = hn::MaxLanes(D());
  static constexpr std::size_t float_lanes = hn::MaxLanes(F());
  static constexpr std::size_t most_rays = 64;

  /// Takes the rays; false when they do not make a block: they go into different octants or far apart, or single
  /// precision cannot follow one of them.
  bool Begin(const CellTree& cells, std::span<const RayQuery> rays) {
    queries = rays;
    count = queries.size();
    padded = (count + float_lanes - 1) / float_lanes * float_lanes;
    return Load() && FindStarts(cells);
  }

  /// Those from place i on, as many as a vector has doubles.
  SceneRays<D> At(std::size_t i) const {
    const D d;
    SceneRays<D> ray;
    ray.origin = {hn::Load(d, &origin[0][i]), hn::Load(d, &origin[1][i]), hn::Load(d, &origin[2][i])};
    ray.direction = {hn::Load(d, &direction[0][i]), hn::Load(d, &direction[1][i]), hn::Load(d, &direction[2][i])};
    ray.slowness = {hn::Load(d, &slowness[0][i]), hn::Load(d, &slowness[1][i]), hn::Load(d, &slowness[2][i])};
    ray.inverse_square = hn::Load(d, &inverse_square[i]);
    ray.length = hn::Load(d, &length[i]);
    ray.near = hn::Load(d, &near[i]);
    ray.flat = flat;
    return ray;
  }

  std::span<const RayQuery> queries;
  std::size_t count = 0, padded = 0;      ///< rays, and with those that fill the last vector
  std::array<std::size_t, 3> backward{};  ///< by axis: 1 where all directions are negative
  bool flat = false;                      ///< some ray is nearly parallel to an axis plane
  bool has_from = false;                  ///< some ray starts on a surface
  bool all_miss = false;                  ///< none meets the scene

  HWY_ALIGN double origin[3][most_rays];  ///< where the ray meets the scene, relative to its centre
  HWY_ALIGN double query_origin[3][most_rays];
  HWY_ALIGN double direction[3][most_rays];
  HWY_ALIGN double slowness[3][most_rays];
  HWY_ALIGN double inverse_square[most_rays];
  HWY_ALIGN double length[most_rays];
  HWY_ALIGN double near[most_rays];
  HWY_ALIGN double start[most_rays];  ///< the query's t where the ray meets the scene
  HWY_ALIGN double end[most_rays];    ///< the query's t_max; below zero where there is no ray

  /// The same in single precision, for boxes; `box_end` is counted from the start, and below zero for a ray that is
  /// done.
  HWY_ALIGN float box_origin[3][most_rays];
  HWY_ALIGN float box_inverse[3][most_rays];
  HWY_ALIGN float box_end[most_rays];
  /// What holds those of all rays that are not done at the beginning.
  float low_origin[3] = {}, high_origin[3] = {}, low_inverse[3] = {}, high_inverse[3] = {};

 private:
  bool Load() {
    const RayKind kind = queries[0].kind;
    has_from = false;
    for (std::size_t i = 0; i < count; ++i) {
      const RayQuery& q = queries[i];
      if (q.kind != kind) return false;
      for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        query_origin[a][i] = q.ray.origin[axis];
        direction[a][i] = q.ray.direction[axis];
      }
      end[i] = q.t_max;
      has_from |= q.from != nullptr;
    }
    // Lanes without a ray repeat the last one, and have no length.
    for (std::size_t i = count; i < padded; ++i) {
      for (std::size_t a = 0; a < 3; ++a) {
        query_origin[a][i] = query_origin[a][count - 1];
        direction[a][i] = direction[a][count - 1];
      }
      end[i] = -1;
    }
    return true;
  }

  // Where the rays meet the scene's box, what the kernels want to know of them, and the intervals that hold them all.
  bool FindStarts(const CellTree& cells) {
    const D d;
    const HalfF f;
    const auto zero = hn::Zero(d), most = hn::Set(d, 0x1p100), unit = hn::Set(d, 1.0);
    for (std::size_t a = 0; a < 3; ++a) {
      backward[a] = direction[a][0] < 0 ? 1 : 0;
      low_origin[a] = low_inverse[a] = std::numeric_limits<float>::infinity();
      high_origin[a] = high_inverse[a] = -std::numeric_limits<float>::infinity();
    }
    flat = false;
    HWY_ALIGN double low_share[3][double_lanes], high_share[3][double_lanes];
    for (std::size_t a = 0; a < 3; ++a) {
      hn::Store(hn::Set(d, 2.0), d, low_share[a]);
      hn::Store(hn::Set(d, -2.0), d, high_share[a]);
    }
    for (std::size_t i = 0; i < padded; i += double_lanes) {
      const hn::Vec<D> o[3] = {hn::Load(d, &query_origin[0][i]), hn::Load(d, &query_origin[1][i]),
                               hn::Load(d, &query_origin[2][i])};
      const hn::Vec<D> v[3] = {hn::Load(d, &direction[0][i]), hn::Load(d, &direction[1][i]),
                               hn::Load(d, &direction[2][i])};
      const auto square = Dot(Vec3Lanes<D>{v[0], v[1], v[2]}, Vec3Lanes<D>{v[0], v[1], v[2]});
      const auto farthest = hn::Max(hn::Max(hn::Abs(o[0]), hn::Abs(o[1])), hn::Abs(o[2]));
      const auto sound = hn::And(hn::Le(farthest, hn::Set(d, cells.scale.far_origin)),
                                 hn::And(hn::Ge(square, hn::Set(d, 0x1p-200)), hn::Le(square, hn::Set(d, 0x1p200))));
      if (!hn::AllTrue(d, sound)) return false;
      const auto speed = hn::Sqrt(square);
      const auto inverse_length = hn::Div(unit, speed);
      const auto least = hn::Mul(hn::Set(d, cells.records.least_slope), speed);
      auto first = zero, last = hn::Load(d, &end[i]);
      hn::Vec<D> inverse[3];
      for (std::size_t a = 0; a < 3; ++a) {
        const bool is_backward = backward[a] != 0;
        const auto forward = hn::Gt(v[a], zero), against = hn::Lt(v[a], zero);
        // A direction of zero has no side of its own; it is left to single rays.
        if (!hn::AllTrue(d, is_backward ? against : forward)) return false;
        flat |= !hn::AllFalse(d, hn::Le(hn::Abs(v[a]), least));
        inverse[a] = hn::Max(hn::Min(hn::Div(unit, v[a]), most), hn::Neg(most));
        const double low = cells.box.lower[static_cast<int>(a)], high = cells.box.upper[static_cast<int>(a)];
        first = hn::Max(first, hn::Mul(hn::Sub(hn::Set(d, is_backward ? high : low), o[a]), inverse[a]));
        last = hn::Min(last, hn::Mul(hn::Sub(hn::Set(d, is_backward ? low : high), o[a]), inverse[a]));
        const auto share = hn::Mul(v[a], inverse_length);
        hn::Store(hn::Min(hn::Load(d, low_share[a]), share), d, low_share[a]);
        hn::Store(hn::Max(hn::Load(d, high_share[a]), share), d, high_share[a]);
      }
      const auto meets = hn::Le(first, last);
      const auto begin = hn::IfThenElse(meets, first, zero);
      hn::Store(begin, d, &start[i]);
      hn::Store(hn::Mul(inverse_length, inverse_length), d, &inverse_square[i]);
      hn::Store(speed, d, &length[i]);
      const auto two_resolutions = hn::Set(d, 2 * cells.scale.resolution);
      hn::Store(hn::Mul(two_resolutions, inverse_length), d, &near[i]);
      for (std::size_t a = 0; a < 3; ++a) {
        const auto from = hn::Add(hn::Sub(o[a], hn::Set(d, cells.center[static_cast<int>(a)])), hn::Mul(begin, v[a]));
        hn::Store(from, d, &origin[a][i]);
        hn::Store(inverse[a], d, &slowness[a][i]);
        hn::Store(hn::DemoteTo(f, from), f, &box_origin[a][i]);
        hn::Store(hn::DemoteTo(f, inverse[a]), f, &box_inverse[a][i]);
      }
      // Rounded up; below zero for rays that do not meet the scene.
      const auto way = hn::Mul(hn::Sub(last, first), hn::Set(d, 1 + 0x1p-20));
      const auto shown = hn::IfThenElse(meets, hn::Min(way, most), hn::Set(d, -1.0));
      hn::Store(hn::DemoteTo(f, shown), f, &box_end[i]);
    }
    for (std::size_t a = 0; a < 3; ++a) {
      const double least = *std::min_element(low_share[a], low_share[a] + double_lanes);
      const double greatest = *std::max_element(high_share[a], high_share[a] + double_lanes);
      if (greatest - least > widest_spread) return false;
    }
    return FindIntervals();
  }

  // Rays further apart than this share few cells: the spread of a component of their directions, at length 1. Set by
  // trial on the bench; it decides who traces a ray, never what comes of it.
  static constexpr double widest_spread = 0.25;

  bool FindIntervals() {
    bool any = false;
    for (std::size_t i = 0; i < count; ++i) {
      if (box_end[i] < 0) continue;
      any = true;
      for (std::size_t a = 0; a < 3; ++a) {
        low_origin[a] = std::min(low_origin[a], box_origin[a][i]);
        high_origin[a] = std::max(high_origin[a], box_origin[a][i]);
        low_inverse[a] = std::min(low_inverse[a], box_inverse[a][i]);
        high_inverse[a] = std::max(high_inverse[a], box_inverse[a][i]);
      }
    }
    all_miss = !any;
    return true;
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#endif
