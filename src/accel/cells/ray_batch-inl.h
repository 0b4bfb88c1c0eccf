// Many rays side by side. Included once for each instruction set.

#if defined(TENON_ACCEL_CELLS_RAY_BATCH_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TENON_ACCEL_CELLS_RAY_BATCH_INL_H_
#undef TENON_ACCEL_CELLS_RAY_BATCH_INL_H_
#else
#define TENON_ACCEL_CELLS_RAY_BATCH_INL_H_
#endif

#include <hwy/highway.h>

#include <hwy/cache_control.h>

#include <algorithm>
#include <cstddef>
#include <limits>

#include "accel/cells/cell_trace.h"
#include "accel/cells/scene_rays-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tenon::cells {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Up to 64 rays, and what the kernels want to know of them.
struct RayBatch {
  using D = hn::CappedTag<double, 8>;
  using F = hn::CappedTag<float, 16>;
  // As many floats as there are doubles in a vector.
  using HalfF = hn::Rebind<float, D>;
  static constexpr std::size_t double_lanes = hn::MaxLanes(D());
  static constexpr std::size_t float_lanes = hn::MaxLanes(F());
  static constexpr std::size_t most_rays = 64;

  /// Takes the rays.
  /// @param later  those of the next batch, which are called to the cache
  void Begin(const CellTree& cells, std::span<const RayQuery> rays, std::span<const RayQuery> later) {
    queries = rays;
    count = queries.size();
    padded = (count + float_lanes - 1) / float_lanes * float_lanes;
    Load();
    FindStarts(cells, later);
    FindOctants();
    if (has_from) FindStartLeaves();
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

  /// Those at any places, as many as there are lanes.
  template <class Lanes>
  HWY_INLINE SceneRays<Lanes> At(Lanes d, const std::uint8_t* places) const {
    const auto take = [&](const double* values) {
      return TakeEach(d, [&](std::size_t lane) { return values[places[lane]]; });
    };
    SceneRays<Lanes> ray;
    ray.origin = {take(origin[0]), take(origin[1]), take(origin[2])};
    ray.direction = {take(direction[0]), take(direction[1]), take(direction[2])};
    ray.slowness = {take(slowness[0]), take(slowness[1]), take(slowness[2])};
    ray.inverse_square = take(inverse_square);
    ray.length = take(length);
    ray.near = take(near);
    ray.flat = flat;
    return ray;
  }

  bool meets_scene(std::size_t i) const { return box_end[i] >= 0; }
  /// The rays that meet the scene, a bit each.
  std::uint64_t in_scene() const {
    std::uint64_t rays = 0;
    for (std::size_t i = 0; i < count; ++i) rays |= static_cast<std::uint64_t>(meets_scene(i)) << i;
    return rays;
  }

  std::span<const RayQuery> queries;
  std::size_t count = 0, padded = 0;  ///< rays, and with those that fill the last vector
  std::uint64_t unsound = 0;          ///< rays that single precision cannot follow
  bool flat = false;                  ///< some ray is nearly parallel to an axis plane
  bool has_from = false;              ///< some ray starts on a surface
  bool one_kind = true;               ///< all are of one RayKind

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
  std::uint8_t octant[most_rays];  ///< bit a: backward along axis a

  /// Where `has_from`: the leaves of the faces that the rays start on, numbers of LeafId or below zero, side by side;
  /// of more faces than there is room for, the first.
  static constexpr std::size_t most_start_leaves = 4;
  HWY_ALIGN double start_leaf[most_start_leaves][most_rays];
  std::size_t start_leaves = 0;  ///< of any ray, at most

 private:
  HWY_NOINLINE void Load() {
    std::uintptr_t from = 0;
    std::uint32_t other_kinds = 0;
    for (const RayQuery& q : queries) {
      from |= reinterpret_cast<std::uintptr_t>(q.from);
      other_kinds |= static_cast<std::uint32_t>(q.kind) ^ static_cast<std::uint32_t>(queries[0].kind);
    }
    has_from = from != 0;
    one_kind = other_kinds == 0;
    for (std::size_t i = LoadFours(); i < count; ++i) {
      const RayQuery& q = queries[i];
      for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        query_origin[a][i] = q.ray.origin[axis];
        direction[a][i] = q.ray.direction[axis];
      }
      end[i] = q.t_max;
    }
    // Lanes without a ray repeat the last one, and have no length.
    for (std::size_t i = count; i < padded; ++i) {
      for (std::size_t a = 0; a < 3; ++a) {
        query_origin[a][i] = query_origin[a][count - 1];
        direction[a][i] = direction[a][count - 1];
      }
      end[i] = -1;
    }
  }

  // Loads as many rays as there are fours of, where a vector has room for four numbers. Those of a ray stand side by
  // side in memory; here each gets a row of its own. @return how many
  std::size_t LoadFours() {
    std::size_t i = 0;
#if HWY_TARGET != HWY_SCALAR
    const hn::CappedTag<double, 4> d;
    if constexpr (hn::MaxLanes(d) == 4) {
      static_assert(offsetof(RayQuery, ray.direction) == 3 * sizeof(double) &&
                    offsetof(RayQuery, t_max) == 6 * sizeof(double) && sizeof(RayQuery) >= 8 * sizeof(double));
      for (; i + 4 <= count; i += 4) {
        for (std::size_t half = 0; half < 2; ++half) {
          const auto numbers = [&](std::size_t ray) {
            return hn::LoadU(d, reinterpret_cast<const double*>(&queries[i + ray]) + 4 * half);
          };
          const auto a = numbers(0), b = numbers(1), c = numbers(2), e = numbers(3);
          const auto ab_even = hn::InterleaveLower(d, a, b), ab_odd = hn::InterleaveUpper(d, a, b);
          const auto ce_even = hn::InterleaveLower(d, c, e), ce_odd = hn::InterleaveUpper(d, c, e);
          hn::Store(hn::ConcatLowerLower(d, ce_even, ab_even), d, (half == 0 ? query_origin[0] : direction[1]) + i);
          hn::Store(hn::ConcatLowerLower(d, ce_odd, ab_odd), d, (half == 0 ? query_origin[1] : direction[2]) + i);
          hn::Store(hn::ConcatUpperUpper(d, ce_even, ab_even), d, (half == 0 ? query_origin[2] : end) + i);
          if (half == 0) hn::Store(hn::ConcatUpperUpper(d, ce_odd, ab_odd), d, direction[0] + i);
        }
      }
    }
#endif
    return i;
  }

  // Asks for what lies further on in memory before it is needed: a little at a time, for there is room for few
  // requests.
  static HWY_INLINE void Prefetch(std::span<const RayQuery> rays) {
    const auto* first = reinterpret_cast<const char*>(rays.data());
    for (std::size_t byte = 0; byte < rays.size_bytes(); byte += 64) hwy::Prefetch(first + byte);
  }

  // Where the rays meet the scene's box.
  HWY_NOINLINE void FindStarts(const CellTree& cells, std::span<const RayQuery> later) {
    const D d;
    const HalfF f;
    const auto zero = hn::Zero(d), most = hn::Set(d, 0x1p100), unit = hn::Set(d, 1.0);
    flat = false;
    unsound = 0;
    for (std::size_t i = 0; i < padded; i += double_lanes) {
      const std::size_t left = later.size() - std::min(i, later.size());
      Prefetch(later.subspan(later.size() - left, std::min(double_lanes, left)));
      const hn::Vec<D> o[3] = {hn::Load(d, &query_origin[0][i]), hn::Load(d, &query_origin[1][i]),
                               hn::Load(d, &query_origin[2][i])};
      const hn::Vec<D> v[3] = {hn::Load(d, &direction[0][i]), hn::Load(d, &direction[1][i]),
                               hn::Load(d, &direction[2][i])};
      const auto square = Dot(Vec3Lanes<D>{v[0], v[1], v[2]}, Vec3Lanes<D>{v[0], v[1], v[2]});
      const auto farthest = hn::Max(hn::Max(hn::Abs(o[0]), hn::Abs(o[1])), hn::Abs(o[2]));
      // Of what is not a number neither holds.
      const auto sound =
          hn::And(hn::And(hn::Le(farthest, hn::Set(d, cells.scale.far_origin)),
                          hn::Eq(hn::Add(hn::Add(o[0], o[1]), o[2]), hn::Add(hn::Add(o[0], o[1]), o[2]))),
                  hn::And(hn::Ge(square, hn::Set(d, 0x1p-200)), hn::Le(square, hn::Set(d, 0x1p200))));
      const auto speed = hn::Sqrt(square);
      const auto inverse_length = hn::Div(unit, speed);
      const auto least = hn::Mul(hn::Set(d, cells.records.least_slope), speed);
      auto first = zero, last = hn::Load(d, &end[i]);
      hn::Vec<D> inverse[3];
      for (std::size_t a = 0; a < 3; ++a) {
        flat |= !hn::AllFalse(d, hn::Le(hn::Abs(v[a]), least));
        inverse[a] = hn::Max(hn::Min(hn::Div(unit, v[a]), most), hn::Neg(most));
        const double low = cells.box.lower[static_cast<int>(a)], high = cells.box.upper[static_cast<int>(a)];
        const auto to_low = hn::Mul(hn::Sub(hn::Set(d, low), o[a]), inverse[a]);
        const auto to_high = hn::Mul(hn::Sub(hn::Set(d, high), o[a]), inverse[a]);
        first = hn::Max(first, hn::Min(to_low, to_high));
        last = hn::Min(last, hn::Max(to_low, to_high));
      }
      unsound |= static_cast<std::uint64_t>(Bits(hn::Not(sound))) << i;
      const auto meets = hn::And(sound, hn::Le(first, last));
      const auto begin = hn::IfThenElseZero(meets, first);
      hn::Store(begin, d, &start[i]);
      hn::Store(hn::Mul(inverse_length, inverse_length), d, &inverse_square[i]);
      hn::Store(speed, d, &length[i]);
      hn::Store(hn::Mul(hn::Set(d, 2 * cells.scale.resolution), inverse_length), d, &near[i]);
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
    if (count < most_rays) unsound &= (std::uint64_t{1} << count) - 1;
  }

  HWY_NOINLINE void FindStartLeaves() {
    start_leaves = 0;
    for (std::size_t i = 0; i < padded; ++i) {
      for (std::size_t k = 0; k < start_leaves; ++k) start_leaf[k][i] = -1;
      if (i >= count || queries[i].from == nullptr) continue;
      const auto& faces = queries[i].from->faces;
      const std::size_t kept = std::min(faces.size(), most_start_leaves);
      for (; start_leaves < kept; ++start_leaves) std::fill_n(start_leaf[start_leaves], padded, -1.0);
      for (std::size_t k = 0; k < kept; ++k) start_leaf[k][i] = static_cast<double>(faces[k].leaf.get());
    }
  }

  void FindOctants() {
    for (std::size_t i = 0; i < count; ++i) {
      octant[i] = static_cast<std::uint8_t>(static_cast<int>(box_inverse[0][i] < 0) |
                                            static_cast<int>(box_inverse[1][i] < 0) << 1 |
                                            static_cast<int>(box_inverse[2][i] < 0) << 2);
    }
  }

 public:
  static std::uint32_t Bits(hn::Mask<D> mask) {
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(D(), mask, bits);
    return bits[0];
  }
};

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#endif
