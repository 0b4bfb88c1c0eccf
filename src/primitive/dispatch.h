#pragma once

#include <cstdint>
#include <optional>

#include "primitive/local_box.h"
#include "primitive/local_ray.h"
#include "primitive/next_crossing.h"
#include "primitive/placement.h"
#include "primitive/ray_packet.h"
#include "tenon/primitive/crossing.h"
#include "tenon/primitive/primitive_store.h"

/// What can be asked of a primitive without knowing its kind. The closed list of kinds (all.h) is known to dispatch.cpp
/// alone.
namespace tenon {

/// Appends all crossings of the ray's whole line with the primitive, sorted by t, to `out`. See Crossing and LocalRay.
void spans(const PrimitiveStore& store, PrimitiveId id, const LocalRay& ray, Spans& out);

/// The same for a ray of the world. Of what lies before t = 0 a primitive with `tells_from_start` tells but whether the
/// ray starts inside.
void spans(const PrimitiveStore& store, PrimitiveId id, const Placement& placement, const Ray& ray, double tolerance,
           int on_face, Spans& out);
/// The crossings of the whole line for a ray of the frame that the placement is in, which may be the local frame of
/// something larger.
void spans(const PrimitiveStore& store, PrimitiveId id, const Placement& placement, const LocalRay& ray, Spans& out);

/// The crossings of spans() whose intervals reach into a window, as spans() has them, but for those that cannot be told
/// from others beyond its ends. Of others some may be missing, and some that there are not may stand for them; what is
/// inside of the window and what is outside is right.
/// @param mapped  the ray in the primitive's frame
/// @param window  of the ray that was mapped
void spans_within(const PrimitiveStore& store, PrimitiveId id, const Placement::MappedRay& mapped,
                  const LineWindow& window, Spans& out);
/// The share of the cost of spans() that this takes however small the window; 1 where windows make no difference.
double window_share(const PrimitiveStore& store, PrimitiveId id);

/// Whether crossing_near() may say something.
bool has_crossing_near(const PrimitiveStore& store, PrimitiveId id);

/// The crossing that spans() has within `near` of t, entering or leaving, of which it is known that it is there: what
/// spans() says of it, sooner. Nothing where it takes the whole of spans() to tell.
/// @param mapped   the ray in the primitive's frame
/// @param t, near  of the ray that was mapped
std::optional<Crossing> crossing_near(const PrimitiveStore& store, PrimitiveId id, const Placement::MappedRay& mapped,
                                      double t, double near, bool entering);

/// Whether next_crossing() may say something.
bool has_next_crossing(const PrimitiveStore& store, PrimitiveId id);

/// The first crossing of spans() behind a place, sooner than by all of them.
/// @param mapped  the ray in the primitive's frame
/// @param search  of the ray that was mapped
NextCrossing next_crossing(const PrimitiveStore& store, PrimitiveId id, const Placement::MappedRay& mapped,
                           const CrossingSearch& search);

/// Whether next_crossings() may say something.
bool tells_packets(const PrimitiveStore& store, PrimitiveId id);

/// The same for rays of the world that go much the same way, together: the first crossings behind t = 0, where they
/// begin.
/// @param id  one that tells_packets()
void next_crossings(const PrimitiveStore& store, PrimitiveId id, const Placement& placement, const RayPacket& rays,
                    double tolerance, PacketCrossings& found);

/// The largest n·p over the primitive's points p, in the local frame; +inf where it is unbounded.
double support(const PrimitiveStore& store, PrimitiveId id, const Vec3& n);

/// The smallest box of the local frame around the primitive, rounded outward; infinite where it is unbounded.
Box3 local_bounds(const PrimitiveStore& store, PrimitiveId id);

/// The smallest box of the world around the placed primitive, never too small: rounding is added outward.
Box3 world_bounds(const PrimitiveStore& store, PrimitiveId id, const BoundedAffine3& world_from_local);

/// The largest n·p over the placed primitive's points p in the world, rounded up; +inf where it is unbounded. The error
/// of the placement is not in it.
double world_support(const PrimitiveStore& store, PrimitiveId id, const Placement& placement, const Vec3& n);

/// Where a box lies with respect to the primitive.
Region classify(const PrimitiveStore& store, PrimitiveId id, const LocalBox& box);

/// Outward normal at a point of the given face, local frame, any length but zero.
Vec3 normal(const PrimitiveStore& store, PrimitiveId id, const Vec3& point, std::uint32_t face);

/// A number that all its faces' numbers are below; nothing for a primitive whose face numbers hold more than a count.
std::optional<std::uint32_t> face_count(const PrimitiveStore& store, PrimitiveId id);

/// Whether the primitive is a surface without inside, a probe that never cuts (Crossing::surface).
bool is_surface(const PrimitiveStore& store, PrimitiveId id);

/// Relative cost of spans(), for the surface area heuristic; a sphere's is 1.
double cost(const PrimitiveStore& store, PrimitiveId id);

}  // namespace tenon
