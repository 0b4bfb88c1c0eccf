#include "primitive/mesh_packet.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdlib>
#include <limits>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "primitive/mesh_packet.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "primitive/mesh_candidate-inl.h"
#include "primitive/mesh_line_bundle-inl.h"
#include "tenon/math/rounding.h"

HWY_BEFORE_NAMESPACE();
namespace tenon {
namespace HWY_NAMESPACE {

using LaneLine = MeshLineOf<LaneNumbers, LaneVec3>;

/// A packet on its way through a mesh: what its rays cross first, and then, each behind where it begins. What
/// NextOfMesh (mesh_next.cpp) does for a line, for a mesh that winds once; what is not certain of a line by this is
/// told by that.
class PacketInMesh {
 public:
  PacketInMesh(const TriangleMesh& mesh, const MeshBvh& bvh, const MeshExtent& extent, const LocalRayPacket& rays,
               PacketCrossings& found)
      : mesh_(mesh),
        bvh_(bvh),
        rays_(rays),
        found_(found),
        facet_(bvh.frame().scale * bvh.frame().scale * extent.facet) {
    const auto first = static_cast<std::size_t>(std::countr_zero(rays.rays));
    const double x = std::fabs(rays.direction[0][first]), y = std::fabs(rays.direction[1][first]),
                 z = std::fabs(rays.direction[2][first]);
    along_ = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
    rises_ = rays.direction[static_cast<std::size_t>(along_)][first] > 0;
    for (std::size_t at = 0; at < most_packet_rays; at += lanes) {
      if (const auto here = BitsAt(rays.rays, at); here != 0) Begin(at, here, extent.bounds);
    }
  }

  void Follow() { Follow(0, most_packet_rays); }

 private:
  static constexpr std::size_t lanes = LaneNumbers::count;
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  // Where rays lie further apart, against half the size of a mesh, or more triangles are to be expected between them,
  // fewer of them go together. By trial on the bench; it decides nothing but how long they take.
  static constexpr double widest = 0.125;
  static constexpr std::size_t triangles_a_ray = 4, fewest = 8;
  using Row = double[most_packet_rays];

  static std::uint32_t BitsAt(std::uint64_t rays, std::size_t at) {
    return static_cast<std::uint32_t>(rays >> at & lanes_mask<lanes>);
  }
  static HWY_INLINE LaneNumbers Load(const Row& row, std::size_t at) { return LaneNumbers::load(row + at); }
  static HWY_INLINE LaneVec3 Load(const std::array<LocalRayPacket::Numbers, 3>& rows, std::size_t at) {
    return {LaneNumbers::load(rows[0].data() + at), LaneNumbers::load(rows[1].data() + at),
            LaneNumbers::load(rows[2].data() + at)};
  }

  // Follows the rays from a place on, so many, together, or in halves.
  void Follow(std::size_t first, std::size_t count) {
    rays_in_ = rays_begun_ & (~std::uint64_t{0} >> (most_packet_rays - count)) << first;
    const auto rays = static_cast<std::size_t>(std::popcount(rays_in_));
    if (rays < fewest) return;
    FloatLine line = BundleLines();
    most_triangles_ = triangles_a_ray * rays;
    if (!(width_ <= widest && ExpectedTriangles() <= static_cast<double>(most_triangles_))) {
      if (count < 2 * fewest) return;
      Follow(first, count / 2);
      Follow(first + count / 2, count / 2);
      return;
    }
    triangles_ = 0;
    reach_ = infinity;
    bvh_.walk_forward(line, [this](std::uint32_t triangle) { return Take(triangle); });
    if (triangles_ > most_triangles_) return;
    for (std::uint64_t left = rays_in_; left != 0; left &= left - 1) {
      Tell(static_cast<std::size_t>(std::countr_zero(left)));
    }
  }

  // As many as there are of the average size in a square as wide as the rays lie apart, and around it, before and
  // behind.
  double ExpectedTriangles() const {
    const double edge = std::sqrt(2 * facet_), wide = 2 * width_ + edge;
    return 2 * wide * wide / facet_;
  }

  // A crossing a lane.
  struct Crossings {
    LaneNumbers t, lo, hi, face;
  };
  // Of each ray the nearest so far; t is that of its line.
  struct Ahead {
    HWY_ALIGN Row t;
    HWY_ALIGN Row lo;
    HWY_ALIGN Row hi;
    HWY_ALIGN Row face;

    // Keeps the nearer of two, and leaves the other. @return whether any is nearer
    HWY_INLINE bool Keep(std::size_t at, LaneConditions where, Crossings& crossing) {
      const Crossings known{Load(t, at), Load(lo, at), Load(hi, at), Load(face, at)};
      const LaneConditions nearer = where & (crossing.t < known.t);
      if (nearer.bits() == 0) return false;
      const auto exchange = [at, nearer](LaneNumbers old, LaneNumbers& other, Row& row) HWY_ATTR {
        choose(nearer, other, old).store(row + at);
        other = choose(nearer, old, other);
      };
      exchange(known.t, crossing.t, t);
      exchange(known.lo, crossing.lo, lo);
      exchange(known.hi, crossing.hi, hi);
      exchange(known.face, crossing.face, face);
      return true;
    }
  };

  // Takes those of a vector of lanes that go as the first one does.
  void Begin(std::size_t at, std::uint32_t asked, const Box3& bounds) {
    const LaneVec3 origin = Load(rays_.origin, at), direction = Load(rays_.direction, at);
    const LaneVec3 origin_error = Load(rays_.origin_error, at), direction_error = Load(rays_.direction_error, at);
    const LaneVec3 size = abs(direction);
    const LaneConditions x_is_largest = (size.x >= size.y) & (size.x >= size.z), y_exceeds_z = size.y >= size.z;
    const LaneConditions along_it = along_ == 0   ? x_is_largest
                                    : along_ == 1 ? LaneConditions((!x_is_largest) & y_exceeds_z)
                                                  : LaneConditions(!(x_is_largest | y_exceeds_z));
    const LaneNumbers sign = rises_ ? 1 : -1, zero = 0;
    const LaneVec3 products = zero * origin + zero * direction + zero * origin_error + zero * direction_error;
    const LaneConditions is_finite = products.x + products.y + products.z == zero;
    LaneConditions goes_along = along_it & is_finite & (sign * direction[along_] > zero);
    LaneLine line;
    line.along = along_;
    SetLine(origin, direction, origin_error, direction_error, bounds, line);
    const FramedLine<LaneNumbers> framed = FrameLine(line, bvh_.frame());
    const LaneNumbers near = LaneNumbers::load(rays_.near + at) / line.scale;
    const LaneNumbers begin = -LaneNumbers::load(rays_.shift.data() + at) / line.scale;
    // Neither comes near the mesh.
    const LaneConditions misses = (begin > line.farthest) | framed.is_beside;
    for (std::uint32_t left = (goes_along & misses).bits() & asked; left != 0; left &= left - 1) {
      found_.first[at + static_cast<std::size_t>(std::countr_zero(left))] = {NextCrossing::Kind::nothing, {}};
    }
    const LaneNumbers growth = larger(framed.growth[0], framed.growth[1]);
    goes_along = goes_along & !misses & (growth <= LaneNumbers(widest));
    rays_begun_ |= static_cast<std::uint64_t>(goes_along.bits() & asked) << at;

    lines_[at / lanes] = line;
    framed_[at / lanes] = framed;
    near.store(near_ + at);
    begin.store(begin_ + at);
    for (Ahead* const crossing : {&first_, &second_}) {
      for (Row* const row : {&crossing->t, &crossing->lo, &crossing->hi}) LaneNumbers(infinity).store(*row + at);
      zero.store(crossing->face + at);
    }
    for (Row* const row : {&other_lo_, &doubtful_lo_}) LaneNumbers(infinity).store(*row + at);
    LaneNumbers(-infinity).store(passed_hi_ + at);
    unsure_[at / lanes] = 0;
  }

  // Finds one line that stands for all rays, which it returns, and one for those of each vector.
  FloatLine BundleLines() {
    NumberRange ups, comes;
    LineBundle all_rays;
    const auto for_each = [this](const auto& visit) HWY_ATTR {
      for (std::size_t at = 0; at < most_packet_rays; at += lanes) {
        if (const auto here = BitsAt(rays_in_, at); here != 0) {
          visit(at / lanes, LaneConditions::from_bits(here), framed_[at / lanes]);
        }
      }
    };
    for_each([&](std::size_t v, LaneConditions here, const FramedLine<LaneNumbers>& line) HWY_ATTR {
      all_rays.Include(here, line);
      ups.Include(here, line.up);
      const LaneNumbers from = Load(begin_, v * lanes) - LaneNumbers(2) * Load(near_, v * lanes);
      comes.Include(here, line.come_at_0 + line.speed * from - line.up);
    });
    all_rays.FindMiddle();
    const double up = ups.high();
    for (std::size_t i = 0; i < 2; ++i) {
      for (Row* const row : {&vector_start_[i], &vector_slope_[i], &vector_error_[i]}) std::fill_n(*row, padded, 0.0);
    }
    for_each([&](std::size_t v, LaneConditions here, const FramedLine<LaneNumbers>& line) HWY_ATTR {
      all_rays.IncludeErrors(here, line, up);
      LineBundle rays;
      rays.Include(here, line);
      rays.FindMiddle();
      rays.IncludeErrors(here, line, up);
      const FramedLine<double> vector = rays.line(up);
      for (std::size_t i = 0; i < 2; ++i) {
        vector_start_[i][v] = vector.start[i];
        vector_slope_[i][v] = vector.slope[i];
        vector_error_[i][v] = vector.error[i];
      }
    });
    const FramedLine<double> all = all_rays.line(up);
    width_ = std::max(all.growth[0], all.growth[1]);
    return {all, along_, rises_, {comes.low(), infinity}};
  }

  // Holds a triangle against all rays. @return how far what is of interest reaches now
  double Take(std::uint32_t triangle) {
    if (++triangles_ > most_triangles_) return -infinity;
    const std::array<Vec3, 3> corners = mesh_.corners(triangle);
    bool is_nearer = false;
    for (std::uint64_t left = FindVectors(corners); left != 0; left &= left - 1) {
      const std::size_t at = static_cast<std::size_t>(std::countr_zero(left)) * lanes;
      if (const auto here = BitsAt(rays_in_, at); here != 0) is_nearer |= Hold(at, here, triangle, corners);
    }
    if (is_nearer) FindReach();
    return reach_;
  }

  // Vectors some of whose rays may cross a triangle, a bit each: as many at once as a vector has doubles, for each
  // stands for its rays as the packet does for all.
  std::uint64_t FindVectors(const std::array<Vec3, 3>& corners) const {
    Vec3 framed[3];
    for (std::size_t i = 0; i < 3; ++i) framed[i] = bvh_.frame().scale * (corners[i] - bvh_.frame().center);
    const int across[2] = {(along_ + 1) % 3, (along_ + 2) % 3};
    std::uint64_t found = 0;
    for (std::size_t first = 0; first < vectors; first += lanes) {
      LaneNumbers places[2][3], error[2];
      for (std::size_t i = 0; i < 2; ++i) {
        const LaneNumbers start = Load(vector_start_[i], first), slope = Load(vector_slope_[i], first);
        for (std::size_t c = 0; c < 3; ++c) {
          places[i][c] = LaneNumbers(framed[c][across[i]]) - start - slope * LaneNumbers(framed[c][along_]);
        }
        error[i] = Load(vector_error_[i], first);
      }
      const auto missed = SeeCorners(places[0], places[1], error).is_missed;
      found |= static_cast<std::uint64_t>(~missed.bits() & lanes_mask<lanes>) << first;
    }
    return found;
  }

  // The same for those of a vector. @return whether any has a nearer crossing now
  bool Hold(std::size_t at, std::uint32_t here, std::uint32_t triangle, const std::array<Vec3, 3>& corners) {
    const LaneLine& line = lines_[at / lanes];
    const SeenTriangle<LaneNumbers> seen = SeeTriangle(line, corners);
    LaneConditions met = LaneConditions::from_bits(here) & !seen.is_missed;
    // That a ray starts on it is known, and where it goes from there the next crossing tells.
    if (rays_.on_face != nullptr) met = met & !(LaneNumbers::load(rays_.on_face + at) == LaneNumbers(triangle));
    if (met.bits() == 0) return false;
    const TrianglePlace<LaneNumbers> place = FindPlace(line, corners, seen.areas);
    const auto keep_least = [at](LaneConditions where, LaneNumbers value, Row& row) HWY_ATTR {
      choose(where, smaller(Load(row, at), value), Load(row, at)).store(row + at);
    };
    const LaneNumbers begin = Load(begin_, at), near = Load(near_, at);
    const LaneConditions matters = met & !(place.hi < begin - LaneNumbers(2) * near);
    keep_least(matters & !seen.is_certain, place.lo, doubtful_lo_);
    const LaneConditions crossed = matters & seen.is_certain;
    const LaneConditions passed = crossed & (place.hi <= begin), ahead = crossed & (place.lo > begin);
    const LaneConditions is_apart = magnitude(place.t - begin) > near, is_ordered = place.lo <= place.hi;
    unsure_[at / lanes] |= ((crossed & !(is_apart & (passed | ahead))) | (matters & !is_ordered)).bits();
    choose(passed, larger(Load(passed_hi_, at), place.hi), Load(passed_hi_, at)).store(passed_hi_ + at);
    // Numbers from one on, below zero where the line leaves the solid.
    const LaneNumbers number = 1.0 + triangle;
    const LaneConditions leaves = rises_ ? seen.positive : LaneConditions(!seen.positive);
    Crossings crossing{place.t, place.lo, place.hi, choose(leaves, -number, number)};
    const bool is_nearer = first_.Keep(at, ahead, crossing);
    if (!found_.wants_second) {
      keep_least(ahead, crossing.lo, other_lo_);
      return is_nearer;
    }
    const bool is_second = second_.Keep(at, ahead, crossing);
    keep_least(ahead, crossing.lo, other_lo_);
    return is_nearer || is_second;
  }

  void FindReach() {
    // What lies further than cannot be told from the last that is wanted is of no interest.
    const Ahead& last = found_.wants_second ? second_ : first_;
    LaneNumbers reach = -infinity;
    for (std::size_t at = 0; at < most_packet_rays; at += lanes) {
      const auto here = BitsAt(rays_in_, at);
      if (here == 0) continue;
      const FramedLine<LaneNumbers>& line = framed_[at / lanes];
      const LaneNumbers end = Load(last.hi, at) + LaneNumbers(2) * Load(near_, at);
      const LaneNumbers come = line.come_at_0 + line.speed * end + line.up;
      reach = larger(reach, choose(LaneConditions::from_bits(here), come, LaneNumbers(-infinity)));
    }
    reach_ = hn::GetLane(hn::MaxOfLanes(LaneNumbers::D(), reach.v));
  }

  // What is known of a ray. One of which it is not certain that it is there may come first, or be as near to another as
  // cannot be told apart; so may any two.
  void Tell(std::size_t i) {
    if ((unsure_[i / lanes] >> (i % lanes) & 1) != 0) return;
    const double near = near_[i], first = first_.t[i], second = second_.t[i];
    const auto is_behind = [&](double place) { return place == infinity || place - first > near; };
    const double others = std::min(doubtful_lo_[i], other_lo_[i]);
    if (first == infinity) {
      if (doubtful_lo_[i] == infinity) found_.first[i].kind = NextCrossing::Kind::nothing;
    } else if (is_behind(others) && is_behind(second_.lo[i]) && first - passed_hi_[i] > near) {
      found_.first[i] = TellCrossing(first_, i);
    }
    if (!found_.wants_second || found_.first[i].kind != NextCrossing::Kind::found) return;
    if (second == infinity) {
      if (doubtful_lo_[i] == infinity) found_.second[i].kind = NextCrossing::Kind::nothing;
    } else if (others - second > near && second - first_.hi[i] > near) {
      found_.second[i] = TellCrossing(second_, i);
    }
  }

  NextCrossing TellCrossing(const Ahead& crossing, std::size_t i) const {
    NextCrossing next;
    const double scale = ScaleOf(i), t = crossing.t[i];
    const double bound = scale * std::max(crossing.hi[i] - t, t - crossing.lo[i]) * (1 + gamma(4));
    if (!(bound <= 0.5 * scale * near_[i]) || !std::isfinite(scale * t)) return next;
    const auto face = static_cast<std::int64_t>(crossing.face[i]);
    next.crossing = {scale * t, bound, static_cast<std::uint32_t>(std::abs(face) - 1), face > 0, false};
    next.kind = NextCrossing::Kind::found;
    return next;
  }

  double ScaleOf(std::size_t i) const {
    HWY_ALIGN double scales[lanes];
    lines_[i / lanes].scale.store(scales);
    return scales[i % lanes];
  }

  const TriangleMesh& mesh_;
  const MeshBvh& bvh_;
  const LocalRayPacket& rays_;
  PacketCrossings& found_;
  int along_;
  bool rises_;
  double facet_;                  // the area of a triangle, on average, in the frame of the hierarchy
  std::uint64_t rays_begun_ = 0;  // those that go as the first one does, a bit each
  // Of those that are followed together.
  std::uint64_t rays_in_ = 0;
  double width_ = 0;  // how far a line is from the middle of all
  double reach_ = infinity;
  std::size_t triangles_ = 0, most_triangles_ = 0;
  // By vector of lanes.
  std::array<LaneLine, most_packet_rays / lanes> lines_;
  std::array<FramedLine<LaneNumbers>, most_packet_rays / lanes> framed_;
  std::array<std::uint32_t, most_packet_rays / lanes> unsure_;
  static constexpr std::size_t vectors = most_packet_rays / lanes;
  static constexpr std::size_t padded = (vectors + lanes - 1) / lanes * lanes;
  HWY_ALIGN Row vector_start_[2];
  HWY_ALIGN Row vector_slope_[2];
  HWY_ALIGN Row vector_error_[2];
  // By ray; t is that of its line.
  HWY_ALIGN Row begin_;
  HWY_ALIGN Row near_;
  Ahead first_, second_;
  HWY_ALIGN Row other_lo_;     // where the first of all others may be that lie ahead
  HWY_ALIGN Row passed_hi_;    // where the last may be that lies before the beginning
  HWY_ALIGN Row doubtful_lo_;  // where the first may be of which it is not certain that it is there
};

void FindNextCrossings(const TriangleMesh& mesh, const MeshBvh& bvh, const MeshExtent& extent,
                       const LocalRayPacket& rays, PacketCrossings& found) {
  PacketInMesh(mesh, bvh, extent, rays, found).Follow();
}

}  // namespace HWY_NAMESPACE
}  // namespace tenon
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tenon {

HWY_EXPORT(FindNextCrossings);

void find_next_crossings(const TriangleMesh& mesh, const MeshBvh& bvh, const MeshExtent& extent,
                         const LocalRayPacket& rays, PacketCrossings& found) {
  assert(mesh.winds_once);
  if (rays.rays != 0) HWY_DYNAMIC_DISPATCH(FindNextCrossings)(mesh, bvh, extent, rays, found);
}

}  // namespace tenon
#endif
