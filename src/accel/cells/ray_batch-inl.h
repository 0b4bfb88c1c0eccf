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
#include <bit>
#include <cstddef>
#include <limits>

#include "accel/cells/cell_trace.h"
#include "accel/cells/scene_rays-inl.h"
#include "primitive/ray_packet.h"

HWY_BEFORE_NAMESPACE();
namespace tenon::cells {
namespace HWY_NAMESPACE {

/// Up to 64 rays, and what the kernels want to know of them.
struct RayBatch {
  using D = hn::CappedTag<double, 8>;
  using F = hn::CappedTag<float, 16>;
  // As many floats as there are doubles in a vector.
  using HalfF = hn::Rebind<float, D>;
  static constexpr std::size_t double_lanes = hn::MaxLanes(D());
  static constexpr std::size_t float_lanes = hn::MaxLanes(F());
  static constexpr std::size_t most_rays = 64;

  /// Takes the first of some rays: as many as there is room for, or fewer, where those that follow go another way.
  void Begin(const CellTree& cells, std::span<const RayQuery> rays) {
    queries = rays.first(std::min(most_rays, rays.size()));
    Load();
    queries = queries.first(FirstRun());
    count = queries.size();
    padded = (count + float_lanes - 1) / float_lanes * float_lanes;
    later_ = rays.subspan(count, std::min(most_rays, rays.size() - count));
    LookAtQueries();
    Pad();
    FindStarts(cells);
    if (has_from) FindStartLeaves();
  }

  /// Asks for some of the rays of the next batch before they are needed, each time for others: a few at a time, for
  /// memory takes few requests at once.
  HWY_INLINE void CallLater(std::size_t most) {
    const std::span<const RayQuery> rays = later_.first(std::min(most, later_.size()));
    later_ = later_.subspan(rays.size());
    const auto* first = reinterpret_cast<const char*>(rays.data());
    for (std::size_t byte = 0; byte < rays.size_bytes(); byte += 64) hwy::Prefetch(first + byte);
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

  /// The rays that meet the scene, a bit each.
  std::uint64_t in_scene() const {
    const F f;
    std::uint64_t rays = 0;
    for (std::size_t i = 0; i < padded; i += float_lanes) {
      std::uint8_t bits[8] = {};
      hn::StoreMaskBits(f, hn::Ge(hn::Load(f, &box_end[i]), hn::Zero(f)), bits);
      rays |= static_cast<std::uint64_t>(bits[0] | bits[1] << 8) << i;
    }
    return rays;
  }
  /// Those, as they are asked for what they cross of a leaf.
  RayPacket packet() const {
    return {in_scene(),
            {query_origin[0], query_origin[1], query_origin[2]},
            {direction[0], direction[1], direction[2]},
            near,
            nullptr};
  }
  /// Bit a: backward along axis a.
  std::uint32_t octant(std::size_t i) const {
    const auto sign = [&](std::size_t a) { return std::bit_cast<std::uint32_t>(box_inverse[a][i]) >> 31; };
    return sign(0) | sign(1) << 1 | sign(2) << 2;
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
  HWY_ALIGN float box_shift[3][most_rays];  ///< BoxRay::shift
  HWY_ALIGN float box_end[most_rays];

  /// Where `has_from`: the leaves of the faces that the rays start on, numbers of LeafId or below zero, side by side;
  /// of more faces than there is room for, the first.
  static constexpr std::size_t most_start_leaves = 4;
  HWY_ALIGN double start_leaf[most_start_leaves][most_rays];
  std::size_t start_leaves = 0;  ///< of any ray, at most

 private:
  // Rays whose runs into one octant are shorter on average go all ways; longer ones are blocks (BlockTracer), or what
  // is left of them. By trial on the bench; it decides nothing but how long they take.
  static constexpr std::size_t least_run = 16;

  // Rays to one light come before those to the next, so of those of a batch the first may go into one octant, and all
  // the others into another.
  // @return how many go the same way as the first; all, where such runs are short
  std::size_t FirstRun() const {
    const D d;
    std::uint64_t turns = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      std::uint64_t backward = 0;
      for (std::size_t i = 0; i < most_rays; i += double_lanes) {
        backward |= static_cast<std::uint64_t>(Bits(hn::Lt(hn::Load(d, &direction[a][i]), hn::Zero(d)))) << i;
      }
      turns |= backward ^ backward >> 1;
    }
    const std::size_t all = queries.size();
    turns &= (std::uint64_t{1} << (all - 1)) - 1;
    const auto runs = static_cast<std::size_t>(std::popcount(turns)) + 1;
    return runs == 1 || runs * least_run > all ? all : static_cast<std::size_t>(std::countr_zero(turns)) + 1;
  }

  void LookAtQueries() {
    std::uintptr_t from = 0;
    std::uint32_t other_kinds = 0;
    for (const RayQuery& q : queries) {
      from |= reinterpret_cast<std::uintptr_t>(q.from);
      other_kinds |= static_cast<std::uint32_t>(q.kind) ^ static_cast<std::uint32_t>(queries[0].kind);
    }
    has_from = from != 0;
    one_kind = other_kinds == 0;
  }

  HWY_NOINLINE void Load() {
    for (std::size_t i = LoadFours(); i < queries.size(); ++i) {
      const RayQuery& q = queries[i];
      for (int axis = 0; axis < 3; ++axis) {
        const auto a = static_cast<std::size_t>(axis);
        query_origin[a][i] = q.ray.origin[axis];
        direction[a][i] = q.ray.direction[axis];
      }
      end[i] = q.t_max;
    }
  }

  // Lanes without a ray repeat the last one, and have no length.
  void Pad() {
    for (std::size_t i = count; i < padded; ++i) {
      for (std::size_t a = 0; a < 3; ++a) {
        query_origin[a][i] = query_origin[a][count - 1];
        direction[a][i] = direction[a][count - 1];
      }
      end[i] = -1;
    }
  }

  // Loads as many rays as there are fours of, where a vector has room for four numbers. Those of a ray stand side by
  // side in memory; here each gets a row of its own.
  // @return how many
  std::size_t LoadFours() {
    std::size_t i = 0;
#if HWY_TARGET != HWY_SCALAR
    const hn::CappedTag<double, 4> d;
    if constexpr (hn::MaxLanes(d) == 4) {
      static_assert(offsetof(RayQuery, ray.direction) == 3 * sizeof(double) &&
                    offsetof(RayQuery, t_max) == 6 * sizeof(double) && sizeof(RayQuery) >= 8 * sizeof(double));
      for (; i + 4 <= queries.size(); i += 4) {
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

  // 1 / v, large instead of infinite, and 1 / |v|. Where no component is tiny they are had from one division, which is
  // what takes longest here: that by the product of all four. They are then off by a few roundings.
  // @param most  see CellScale
  static HWY_INLINE void Invert(const hn::Vec<D>* v, hn::Vec<D> length, hn::Vec<D> most, hn::Vec<D>* inverse,
                                hn::Vec<D>& inverse_length) {
    const D d;
    const auto unit = hn::Set(d, 1.0);
    // Such that the product is a number, and so is its inverse.
    const auto least = hn::Mul(hn::Set(d, 0x1p-30), length);
    const auto smallest = hn::Min(hn::Min(hn::Abs(v[0]), hn::Abs(v[1])), hn::Abs(v[2]));
    const auto is_common = hn::And(hn::Ge(smallest, least), hn::Lt(hn::Abs(hn::Sub(length, unit)), hn::Set(d, 0x1p60)));
    if (HWY_LIKELY(hn::AllTrue(d, is_common))) {
      const auto xy = hn::Mul(v[0], v[1]), zl = hn::Mul(v[2], length);
      const auto of_all = hn::Div(unit, hn::Mul(xy, zl));
      const auto of_xy = hn::Mul(of_all, zl), of_zl = hn::Mul(of_all, xy);
      inverse[0] = hn::Mul(of_xy, v[1]);
      inverse[1] = hn::Mul(of_xy, v[0]);
      inverse[2] = hn::Mul(of_zl, length);
      inverse_length = hn::Mul(of_zl, v[2]);
      return;
    }
    for (std::size_t a = 0; a < 3; ++a) inverse[a] = hn::Max(hn::Min(hn::Div(unit, v[a]), most), hn::Neg(most));
    inverse_length = hn::Div(unit, length);
  }

  // Where the rays meet the scene's box.
  HWY_NOINLINE void FindStarts(const CellTree& cells) {
    const D d;
    const HalfF f;
    const auto zero = hn::Zero(d), most = hn::Set(d, 0x1p100);
    flat = false;
    unsound = 0;
    for (std::size_t i = 0; i < padded; i += double_lanes) {
      CallLater(double_lanes / 2);
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
                  hn::And(hn::Ge(square, hn::Set(d, cells.scale.least_square)),
                          hn::Le(square, hn::Set(d, CellScale::most_square))));
      const auto speed = hn::Sqrt(square);
      const auto least = hn::Mul(hn::Set(d, cells.records.least_slope), speed);
      auto any_flat = hn::Le(hn::Abs(v[0]), least);
      for (std::size_t a = 1; a < 3; ++a) any_flat = hn::Or(any_flat, hn::Le(hn::Abs(v[a]), least));
      flat |= !hn::AllFalse(d, any_flat);
      hn::Vec<D> inverse[3], inverse_length;
      Invert(v, speed, hn::Set(d, cells.scale.most_inverse), inverse, inverse_length);
      auto first = zero, last = hn::Load(d, &end[i]);
      for (std::size_t a = 0; a < 3; ++a) {
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
        const auto box_from = hn::DemoteTo(f, from), box_slowness = hn::DemoteTo(f, inverse[a]);
        hn::Store(box_from, f, &box_origin[a][i]);
        hn::Store(box_slowness, f, &box_inverse[a][i]);
        hn::Store(hn::Mul(box_from, box_slowness), f, &box_shift[a][i]);
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

  std::span<const RayQuery> later_;

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
