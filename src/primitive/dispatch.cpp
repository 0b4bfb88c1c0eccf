#include "primitive/dispatch.h"

#include <bit>
#include <cassert>
#include <cmath>
#include <limits>

#include "primitive/lists.h"
#include "tenon/math/rounding.h"

namespace tenon {

namespace {

// False when any number of the ray is infinite or not a number: 0 * x is 0 for finite x alone.
bool is_finite(const LocalRay& ray) {
  const Vec3 zero = 0.0 * ray.origin + 0.0 * ray.direction + 0.0 * ray.origin_error + 0.0 * ray.direction_error;
  return zero.x + zero.y + zero.z == 0;
}

// support(), rounded up. No support function takes more than eight roundings.
double support_above(const PrimitiveStore& store, PrimitiveId id, const Vec3& n) {
  const double s = support(store, id, n);
  return s + gamma(8) * std::fabs(s);
}

double weigh(double a, double extent) {
  return a == 0 ? 0 : std::fabs(a) * extent;
}

// Appends a primitive's crossings along a line: all of them, or those in a window where it can tell them apart.
void find_spans(const PrimitiveStore& store, PrimitiveId id, const LocalRay& ray, const LineWindow& window,
                Spans& out) {
  if (!is_finite(ray) || ray.direction == Vec3{}) return;
  visit(store.lists(), id, [&](const auto& primitive) {
    if constexpr (requires { primitive.spans_within(ray, window, out); }) {
      primitive.spans_within(ray, window, out);
    } else {
      primitive.spans(ray, out);
    }
  });
}

// To the ray that was mapped.
void move(Crossing& c, double shift) {
  c.t += shift;
  c.bound = (c.bound + unit_roundoff * std::fabs(c.t)) * (1 + gamma(3));
}

}  // namespace

void spans(const PrimitiveStore& store, PrimitiveId id, const LocalRay& ray, Spans& out) {
  find_spans(store, id, ray, {}, out);
}

void spans(const PrimitiveStore& store, PrimitiveId id, const Placement& placement, const Ray& ray, double tolerance,
           int on_face, Spans& out) {
  const bool tells_from_start = visit(store.lists(), id, [](const auto& primitive) {
    return requires {
      primitive.tells_from_start;
    };
  });
  const LineWindow window{tells_from_start ? 0 : -Box3::inf, Box3::inf};
  spans_within(store, id, placement.to_local(ray, tolerance, on_face), window, out);
}

void spans(const PrimitiveStore& store, PrimitiveId id, const Placement& placement, const LocalRay& ray, Spans& out) {
  spans_within(store, id, placement.to_local(ray), {}, out);
}

void spans_within(const PrimitiveStore& store, PrimitiveId id, const Placement::MappedRay& mapped,
                  const LineWindow& window, Spans& out) {
  const double shift = mapped.shift;
  const std::size_t first = out.size();
  find_spans(store, id, mapped.ray, {window.begin - shift, window.end - shift}, out);
  if (shift == 0) return;
  for (std::size_t i = first; i < out.size(); ++i) {
    if (std::isfinite(out[i].t)) move(out[i], shift);
  }
}

double window_share(const PrimitiveStore& store, PrimitiveId id) {
  return visit(store.lists(), id, [](const auto& primitive) {
    if constexpr (requires { primitive.window_share(); }) return primitive.window_share();
    return 1.0;
  });
}

bool has_crossing_near(const PrimitiveStore& store, PrimitiveId id) {
  return visit(store.lists(), id, [](const auto& primitive) {
    return requires(const LocalRay& ray) {
      primitive.crossing_near(ray, 0.0, 0.0, true);
    };
  });
}

std::optional<Crossing> crossing_near(const PrimitiveStore& store, PrimitiveId id, const Placement::MappedRay& mapped,
                                      double t, double near, bool entering) {
  if (!is_finite(mapped.ray) || mapped.ray.direction == Vec3{}) return std::nullopt;
  return visit(store.lists(), id, [&](const auto& primitive) -> std::optional<Crossing> {
    if constexpr (requires { primitive.crossing_near(mapped.ray, t, near, entering); }) {
      std::optional<Crossing> found = primitive.crossing_near(mapped.ray, t - mapped.shift, near, entering);
      if (found && mapped.shift != 0) move(*found, mapped.shift);
      return found;
    } else {
      return std::nullopt;
    }
  });
}

bool has_next_crossing(const PrimitiveStore& store, PrimitiveId id) {
  return visit(store.lists(), id, [](const auto& primitive) {
    return requires(const LocalRay& ray) {
      primitive.next_crossing(ray, CrossingSearch{});
    };
  });
}

NextCrossing next_crossing(const PrimitiveStore& store, PrimitiveId id, const Placement::MappedRay& mapped,
                           const CrossingSearch& search) {
  if (!is_finite(mapped.ray) || mapped.ray.direction == Vec3{}) return {};
  return visit(store.lists(), id, [&](const auto& primitive) -> NextCrossing {
    if constexpr (requires { primitive.next_crossing(mapped.ray, search); }) {
      const double shift = mapped.shift;
      NextCrossing next = primitive.next_crossing(mapped.ray, {search.begin - shift, search.from - shift, search.near});
      if (next.kind == NextCrossing::Kind::found && shift != 0) move(next.crossing, shift);
      return next;
    } else {
      return {};
    }
  });
}

bool tells_packets(const PrimitiveStore& store, PrimitiveId id) {
  return visit(store.lists(), id, [](const auto& primitive) {
    if constexpr (requires { primitive.tells_packets(); }) {
      return primitive.tells_packets();
    } else {
      return false;
    }
  });
}

void next_crossings(const PrimitiveStore& store, PrimitiveId id, const Placement& placement, const RayPacket& rays,
                    double tolerance, PacketCrossings& found) {
  found.clear();
  visit(store.lists(), id, [&](const auto& primitive) {
    if constexpr (requires { primitive.tells_packets(); }) {
      assert(primitive.tells_packets());
      LocalRayPacket local;
      placement.to_local(rays, tolerance, local);
      primitive.next_crossings(local, found);
      for (std::uint64_t left = rays.rays; left != 0; left &= left - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(left));
        if (local.shift[i] == 0) continue;
        for (NextCrossing* const next : {&found.first[i], &found.second[i]}) {
          if (next->kind == NextCrossing::Kind::found) move(next->crossing, local.shift[i]);
        }
      }
    }
  });
}

double support(const PrimitiveStore& store, PrimitiveId id, const Vec3& n) {
  return visit(store.lists(), id, [&](const auto& primitive) { return primitive.support(n); });
}

Box3 local_bounds(const PrimitiveStore& store, PrimitiveId id) {
  Box3 bounds;
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 n;
    n[axis] = 1;
    bounds.upper[axis] = support_above(store, id, n);
    bounds.lower[axis] = -support_above(store, id, -n);
  }
  return bounds;
}

Box3 world_bounds(const PrimitiveStore& store, PrimitiveId id, const BoundedAffine3& world_from_local) {
  const Affine3& map = world_from_local.map;
  const Box3 local = local_bounds(store, id);
  const Vec3 extent = max(abs(local.lower), abs(local.upper));
  const Vec3 error = world_from_local.point_error(extent);
  Box3 bounds;
  for (int axis = 0; axis < 3; ++axis) {
    const Vec3 row = map.row(axis);
    const double origin = map.translation()[axis];
    // The terms of the support along this row, before they cancel.
    const double size = weigh(row.x, extent.x) + weigh(row.y, extent.y) + weigh(row.z, extent.z) + std::fabs(origin);
    const auto above = [&](double support) {
      if (!std::isfinite(support)) return support;
      // Along its one bounded direction an unbounded primitive has but the terms of its face.
      const double terms = std::isfinite(size) ? size : std::fabs(support) + std::fabs(origin);
      const double rounding = gamma(10) * terms;
      return support + error[axis] + rounding;
    };
    bounds.upper[axis] = above(support_above(store, id, row)) + origin;
    bounds.lower[axis] = origin - above(support_above(store, id, -row));
  }
  return bounds;
}

double world_support(const PrimitiveStore& store, PrimitiveId id, const Placement& placement, const Vec3& n) {
  // Taken in the local frame, along the normal mapped there. A score of roundings stand between the two terms and the
  // exact value, the map's own included.
  const Affine3& map = placement.world_from_local();
  const double local = support(store, id, map.transposed_direction(n));
  const double moved = dot(n, map.translation());
  return local + moved + gamma(32) * (std::fabs(local) + std::fabs(moved));
}

Region classify(const PrimitiveStore& store, PrimitiveId id, const LocalBox& box) {
  // A box that reaches to infinity is never certain; neither is one whose corners overflow.
  if (!box.bounds.is_bounded()) return Region::straddles;
  return visit(store.lists(), id, [&](const auto& primitive) { return primitive.classify(box); });
}

Vec3 normal(const PrimitiveStore& store, PrimitiveId id, const Vec3& point, std::uint32_t face) {
  return visit(store.lists(), id, [&](const auto& primitive) { return primitive.normal(point, face); });
}

std::optional<std::uint32_t> face_count(const PrimitiveStore& store, PrimitiveId id) {
  return visit(store.lists(), id, [](const auto& primitive) -> std::optional<std::uint32_t> {
    if constexpr (requires { primitive.face_count(); }) return primitive.face_count();
    return std::nullopt;
  });
}

bool is_surface(const PrimitiveStore& store, PrimitiveId id) {
  return visit(store.lists(), id, [](const auto& primitive) {
    if constexpr (requires { primitive.hull; }) return primitive.hull;
    return false;
  });
}

double cost(const PrimitiveStore& store, PrimitiveId id) {
  return visit(store.lists(), id, [](const auto& primitive) -> double {
    if constexpr (requires { primitive.own_cost(); }) return primitive.own_cost();
    return primitive.relative_cost;
  });
}

}  // namespace tenon
