#include <algorithm>
#include <array>
#include <cmath>

#include "primitive/mesh.h"
#include "primitive/mesh_crossings.h"
#include "primitive/mesh_packet.h"
#include "tenon/math/rounding.h"

namespace tenon {

namespace {

// What a line may cross of a mesh behind a place that is known, up to the first crossing behind another place at least.
class NextOfMesh {
 public:
  NextOfMesh(const MeshLine& line, int on_face, const CrossingSearch& search)
      : line_(line), on_face_(on_face), search_(search) {}

  double from() const { return search_.from / line_.scale; }
  // Begins with what lies nearest behind search.from.
  void begin(const TriangleMesh& mesh, const ClearCells& clear) {
    candidates().clear();
    end_ = Box3::inf;
    // Before it whatever may be as near to a crossing, or to the start, as cannot be told apart. Where a mesh winds
    // once, the next crossing tells on which side it is.
    const double begin = (search_.from - 2 * search_.near) / line_.scale;
    before_ = mesh.winds_once ? ClearCells::Place{begin, 0}
                              : clear.find_before(line_, begin).value_or(ClearCells::Place{-Box3::inf, 0});
  }
  LineWindow window() const { return {before_.t, end_}; }

  // Takes what the line may cross of a triangle. @return where what is of interest ends now
  double take(const TriangleMesh& mesh, std::uint32_t triangle) {
    if (is_crowded()) return end_;
    // That the ray starts here is known, and where it goes from here the next crossing tells. If it is not certain that
    // the line crosses this triangle, another may be crossed as near to the start, and that is seen.
    if (mesh.winds_once && static_cast<int>(triangle) == on_face_) return end_;
    MeshCandidate found;
    if (!find_candidate(line_, mesh, triangle, found) || !window().meets(found.lo, found.hi)) return end_;
    if (has(triangle)) return end_;
    candidates().push_back(found);
    if (line_.scale * found.lo > search_.from) end_ = std::min(end_, found.hi + 2 * search_.near / line_.scale);
    if (is_crowded()) end_ = -Box3::inf;
    return end_;
  }

  // The first boundary behind search.from. Behind a crossing that is none, the search goes on from there.
  // @return whether that is all
  bool tell(const TriangleMesh& mesh, NextCrossing& next) {
    next.kind = NextCrossing::Kind::unsure;
    if (is_crowded()) return true;
    std::vector<MeshCandidate>& all = candidates();
    std::sort(all.begin(), all.end(), [](const MeshCandidate& a, const MeshCandidate& b) { return a.t < b.t; });
    // Whether one counts that reaches over the beginning is not certain; where the mesh winds once, none does.
    const auto is_before = [this](const MeshCandidate& c) { return c.lo <= before_.t; };
    if (!mesh.winds_once && std::any_of(all.begin(), all.end(), is_before)) return true;
    int winding = before_.winding;
    bool has_started = mesh.winds_once || on_face_ < 0 || before_.t > 0;
    for (const MeshCandidate& c : all) {
      if (!c.is_certain) return true;
      const double t = line_.scale * c.t;
      if (mesh.winds_once) winding = c.sense > 0 ? 1 : 0;
      const bool was_inside = winding > 0;
      winding -= c.sense;
      if (static_cast<int>(c.triangle) == on_face_) {
        if (!(std::fabs(t) <= search_.near)) return true;
        has_started = true;
        continue;
      }
      if (std::fabs(t - search_.begin) <= search_.near) return true;
      if (line_.scale * c.hi <= search_.from) continue;
      if (!has_started || !(line_.scale * c.lo > search_.from)) return true;
      if (!is_alone(c)) return true;
      if (was_inside == (winding > 0)) {
        search_.from = line_.scale * c.hi;
        return false;
      }
      const double bound = line_.scale * std::max(c.hi - c.t, c.t - c.lo) * (1 + gamma(4));
      if (!(bound <= 0.5 * search_.near) || !std::isfinite(t)) return true;
      next.crossing = {t, bound, c.triangle, !was_inside, false};
      next.kind = NextCrossing::Kind::found;
      return true;
    }
    if (has_started && (mesh.winds_once || winding == 0)) next.kind = NextCrossing::Kind::nothing;
    return true;
  }

 private:
  static constexpr std::size_t most = 64;
  static std::vector<MeshCandidate>& candidates() {
    thread_local std::vector<MeshCandidate> all;
    return all;
  }
  static bool is_crowded() { return candidates().size() > most; }
  // A kd-tree has a triangle in several leaves.
  static bool has(std::uint32_t triangle) {
    const auto& all = candidates();
    return std::any_of(all.begin(), all.end(), [triangle](const MeshCandidate& c) { return c.triangle == triangle; });
  }
  bool is_alone(const MeshCandidate& c) const {
    const double near = search_.near / line_.scale;
    const auto& all = candidates();
    return std::all_of(all.begin(), all.end(), [&](const MeshCandidate& other) {
      return other.triangle == c.triangle || other.lo - c.t > near || c.t - other.hi > near;
    });
  }

  const MeshLine& line_;
  const int on_face_;
  CrossingSearch search_;
  ClearCells::Place before_{};
  double end_ = 0;  // of the part of the line that is of interest
};

}  // namespace

NextCrossing Mesh::next_crossing(const LocalRay& ray, const CrossingSearch& search) const {
  NextCrossing next;
  if (hull) return next;
  const MeshLine line(ray, index_->bounds);
  NextOfMesh found(line, ray.on_face, search);
  if (found.from() > line.farthest) return {NextCrossing::Kind::nothing, {}};
  // A mesh within a mesh has crossings that are none of the solid's.
  constexpr int most_passed = 64;
  for (int passed = 0; passed < most_passed; ++passed) {
    found.begin(*mesh, index_->clear);
    index_->walk_forward(line, found.window(), [&](std::uint32_t triangle) { return found.take(*mesh, triangle); });
    if (found.tell(*mesh, next)) break;
  }
  return next;
}

bool Mesh::tells_packets() const {
  return !hull && mesh->winds_once && std::holds_alternative<MeshBvh>(index_->structure);
}

void Mesh::next_crossings(const LocalRayPacket& rays, PacketCrossings& found) const {
  find_next_crossings(*mesh, std::get<MeshBvh>(index_->structure), {index_->bounds, index_->facet}, rays, found);
}

std::optional<Crossing> Mesh::crossing_near(const LocalRay& ray, double t, double near, bool entering) const {
  if (hull) return std::nullopt;
  const MeshLine line(ray, index_->bounds);
  const LineWindow window{(t - 2 * near) / line.scale, (t + 2 * near) / line.scale};
  std::optional<MeshCandidate> found;
  bool is_only = true;
  index_->walk(line, window, [&](std::uint32_t triangle) {
    MeshCandidate candidate;
    if (!find_candidate(line, *mesh, triangle, candidate) || !window.meets(candidate.lo, candidate.hi)) return;
    is_only = is_only && (!found || found->triangle == triangle);
    found = candidate;
  });
  if (!found || !is_only || !found->is_certain || (found->sense < 0) != entering) return std::nullopt;
  if (static_cast<int>(found->triangle) == ray.on_face) return std::nullopt;
  const double bound = line.scale * std::max(found->hi - found->t, found->t - found->lo) * (1 + gamma(4));
  const double at = line.scale * found->t;
  if (!(std::fabs(at - t) <= near) || !(window.begin < found->lo && found->hi < window.end)) return std::nullopt;
  return Crossing{at, bound, found->triangle, entering, false};
}

}  // namespace tenon
