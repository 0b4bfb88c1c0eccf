#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "primitive/mesh.h"
#include "primitive/mesh_crossings.h"
#include "tenon/math/rounding.h"

namespace tenon {

namespace {

// A boundary of the solid, or a place where the exact line may meet two that the computed one misses.
struct Boundary {
  double t, lo, hi;
  std::uint32_t triangle;
  int sense;  // -1 enters, 1 leaves
  bool is_touch = false;
  double other_lo = 0, other_hi = 0;  // of a touch: where it may leave; lo and hi: where it may enter
};

// Candidates in doubt, grouped by the edges in doubt that they share.
class DoubtfulGroups {
 public:
  DoubtfulGroups(const TriangleMesh& mesh, const std::vector<MeshCandidate>& candidates) : root_(candidates.size()) {
    std::iota(root_.begin(), root_.end(), std::size_t{0});
    struct Use {
      std::uint32_t low, high;
      std::size_t candidate;
    };
    std::vector<Use> uses;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
      const TriangleMesh::Corners& corners = mesh.triangles[candidates[i].triangle];
      for (std::size_t k = 0; k < 3; ++k) {
        if (!candidates[i].is_doubtful[k]) continue;
        const std::uint32_t a = corners[(k + 1) % 3], b = corners[(k + 2) % 3];
        uses.push_back({std::min(a, b), std::max(a, b), i});
      }
    }
    std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) {
      return std::tie(a.low, a.high, a.candidate) < std::tie(b.low, b.high, b.candidate);
    });
    for (std::size_t i = 1; i < uses.size(); ++i) {
      if (std::tie(uses[i].low, uses[i].high) != std::tie(uses[i - 1].low, uses[i - 1].high)) continue;
      root_[find(uses[i].candidate)] = find(uses[i - 1].candidate);
    }
  }

  std::size_t find(std::size_t i) {
    while (root_[i] != i) i = root_[i] = root_[root_[i]];
    return i;
  }

 private:
  std::vector<std::size_t> root_;
};

// What the members of one group that may face one way have in common: an interval around all of theirs.
struct Reach {
  double lo = std::numeric_limits<double>::infinity(), hi = -std::numeric_limits<double>::infinity();

  void take(const MeshCandidate& c) {
    lo = std::min(lo, c.lo);
    hi = std::max(hi, c.hi);
  }
};

struct Group {
  Reach enter, leave;
  bool has_hits = false;
  std::uint32_t triangle = 0;
};

std::vector<Boundary> boundaries_in_doubt(const TriangleMesh& mesh, const std::vector<MeshCandidate>& candidates) {
  DoubtfulGroups membership(mesh, candidates);
  std::vector<Group> groups(candidates.size());
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const MeshCandidate& c = candidates[i];
    Group& group = groups[membership.find(i)];
    if (c.sense <= 0) group.enter.take(c);
    if (c.sense >= 0) group.leave.take(c);
    group.has_hits |= c.is_hit;
    group.triangle = c.triangle;
  }
  std::vector<Boundary> boundaries;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const MeshCandidate& c = candidates[i];
    const std::size_t root = membership.find(i);
    const Group& group = groups[root];
    if (c.is_hit) {
      const Reach& reach = c.sense < 0 ? group.enter : group.leave;
      boundaries.push_back({c.t, reach.lo, reach.hi, c.triangle, c.sense});
    }
    const Reach &enter = group.enter, &leave = group.leave;
    const bool may_touch = enter.lo <= enter.hi && leave.lo <= leave.hi;
    if (i != root || group.has_hits || !may_touch) continue;
    const double t = 0.25 * (enter.lo + enter.hi + leave.lo + leave.hi);
    boundaries.push_back({t, enter.lo, enter.hi, group.triangle, 0, true, leave.lo, leave.hi});
  }
  return boundaries;
}

// The crossing with the triangle the ray starts on is at 0. Where rounding has made the line miss that triangle, its
// neighbour's in the same sense stands for it.
void put_start_at_zero(std::vector<Boundary>& boundaries, const std::vector<MeshCandidate>& candidates,
                       std::uint32_t face) {
  int sense = 0;
  for (const MeshCandidate& c : candidates) {
    if (c.triangle == face) sense = c.sense;
  }
  Boundary* start = nullptr;
  for (Boundary& b : boundaries) {
    if (b.is_touch) continue;
    if (b.triangle == face) {
      start = &b;
      break;
    }
    const bool may_be_here = b.lo <= 0 && 0 <= b.hi && (sense == 0 || b.sense == sense);
    if (may_be_here && (start == nullptr || std::fabs(b.t) < std::fabs(start->t))) start = &b;
  }
  if (start == nullptr) return;
  start->t = start->lo = start->hi = 0;
  start->triangle = face;
}

double bound_of(double t, double lo, double hi) {
  return std::max({hi - t, t - lo, 0.0}) * (1 + gamma(4));
}

// Walks along the line, counting how often the mesh winds around the place.
class SolidSweep {
 public:
  SolidSweep(std::vector<Boundary>& boundaries, double scale, int winding_before, int winding_behind, Spans& out)
      : boundaries_(boundaries),
        scale_(scale),
        out_(out),
        winding_(winding_before),
        has_odd_count_((winding_before > 0) != (winding_behind > 0)) {
    std::sort(boundaries_.begin(), boundaries_.end(),
              [](const Boundary& a, const Boundary& b) { return a.t != b.t ? a.t < b.t : a.triangle < b.triangle; });
  }

  void run() {
    for (std::size_t i = 0; i < boundaries_.size(); ++i) {
      if (boundaries_[i].is_touch) {
        touch(boundaries_[i]);
        continue;
      }
      // An exit of what was never entered, or a second entrance: of a mesh that does not overlap itself that is
      // rounding, and what is missing comes next.
      const bool is_early = boundaries_[i].sense > 0 ? winding_ == 0 : winding_ == 1;
      if (is_early) bring_partner_before(i);
      const Boundary& b = boundaries_[i];
      const int before = winding_;
      winding_ -= b.sense;
      if (before == 0 && winding_ == 1) enter(b);
      if (before == 1 && winding_ == 0) leave(b);
    }
    // Senses are exact, so as many enter as leave; numbers at the ends of the range are all that can break it.
    if (!out_.empty() && (out_.size() % 2 != 0) != has_odd_count_) out_.pop_back();
  }

 private:
  // The next boundary of the other sense is taken first, if it may lie before this one. The one that is known better
  // says where.
  void bring_partner_before(std::size_t i) {
    for (std::size_t j = i + 1; j < boundaries_.size(); ++j) {
      if (boundaries_[j].is_touch || boundaries_[j].sense == boundaries_[i].sense) continue;
      if (!(boundaries_[j].lo <= boundaries_[i].hi)) return;
      Boundary partner = boundaries_[j];
      if (partner.hi - partner.lo > boundaries_[i].hi - boundaries_[i].lo) partner.t = boundaries_[i].t;
      const auto at = boundaries_.begin();
      std::move_backward(at + static_cast<std::ptrdiff_t>(i), at + static_cast<std::ptrdiff_t>(j),
                         at + static_cast<std::ptrdiff_t>(j + 1));
      boundaries_[i] = partner;
      return;
    }
  }

  void enter(const Boundary& b) {
    entrance_ = out_.size();
    add(b.t, b.lo, b.hi, b.triangle, true);
    entrance_lo_ = b.lo;
    entrance_hi_ = b.hi;
  }

  // Each exact end lies on its side of the other, so neither interval needs to reach past the other's.
  void leave(const Boundary& b) {
    if (entrance_lo_ > -Box3::inf) {
      Crossing& entrance = out_[entrance_];
      const double t = entrance.t / scale_;
      entrance.bound = scale_ * bound_of(t, entrance_lo_, std::min(entrance_hi_, b.hi));
    }
    add(b.t, std::max(b.lo, entrance_lo_), b.hi, b.triangle, false);
  }

  // Within the solid the exact line may leave and enter again, outside of it the other way round; if at all.
  void touch(const Boundary& b) {
    if (winding_ > 1) return;
    const bool inside = winding_ == 1;
    const double first_lo = inside ? b.other_lo : b.lo, first_hi = inside ? b.other_hi : b.hi;
    const double second_lo = inside ? b.lo : b.other_lo, second_hi = inside ? b.hi : b.other_hi;
    if (!(first_lo <= second_hi)) return;
    add(b.t, first_lo, std::min(first_hi, second_hi), b.triangle, !inside);
    add(b.t, std::max(first_lo, second_lo), second_hi, b.triangle, inside);
  }

  // Crossings come in order; where errors have brought them out of it, the later one is moved up to the earlier.
  void add(double t, double lo, double hi, std::uint32_t triangle, bool entering) {
    if (!out_.empty()) t = std::max(t, last_t_);
    last_t_ = t;
    out_.push_back({scale_ * t, scale_ * bound_of(t, lo, hi), triangle, entering, false});
  }

  std::vector<Boundary>& boundaries_;
  double scale_;
  Spans& out_;
  int winding_;
  bool has_odd_count_;  // of crossings
  double last_t_ = 0;
  std::size_t entrance_ = 0;
  double entrance_lo_ = -Box3::inf, entrance_hi_ = 0;  // of where the line was last found to enter, if anywhere
};

bool all_finite(const Spans& out) {
  return std::all_of(out.begin(), out.end(),
                     [](const Crossing& c) { return std::isfinite(c.t) && !std::isnan(c.bound); });
}

// Whether the line meets a candidate within a window, at whose ends the boxes of all triangles are away. If its
// interval does not tell, its box does, which the line passes on one side of an end.
bool lies_within(const MeshLine& line, const TriangleMesh& mesh, const LineWindow& window, MeshCandidate& candidate) {
  if (!(candidate.lo <= window.begin) && !(candidate.hi >= window.end)) return true;
  if (!window.meets(candidate.lo, candidate.hi)) return false;
  const auto [a, b, c] = mesh.corners(candidate.triangle);
  double enter, leave;
  MeshSlabs(line).clip({min(a, min(b, c)), max(a, max(b, c))}, enter, leave);
  if (leave < window.begin || enter > window.end) return false;
  candidate.lo = std::max(candidate.lo, window.begin);
  candidate.hi = std::min(candidate.hi, window.end);
  candidate.t = std::clamp(candidate.t, window.begin, window.end);
  return true;
}

}  // namespace

void emit_solid(const TriangleMesh& mesh, std::vector<MeshCandidate>& candidates, double scale, int winding_before,
                int winding_behind, int on_face, Spans& out) {
  thread_local std::vector<Boundary> boundaries;
  boundaries.clear();
  if (std::all_of(candidates.begin(), candidates.end(), [](const MeshCandidate& c) { return c.is_certain; })) {
    for (const MeshCandidate& c : candidates) boundaries.push_back({c.t, c.lo, c.hi, c.triangle, c.sense});
  } else {
    boundaries = boundaries_in_doubt(mesh, candidates);
  }
  if (on_face >= 0) put_start_at_zero(boundaries, candidates, static_cast<std::uint32_t>(on_face));
  thread_local Spans crossings;
  crossings.clear();
  SolidSweep(boundaries, scale, winding_before, winding_behind, crossings).run();
  // A ray so far off that its products overflow.
  if (!all_finite(crossings)) return;
  if (winding_before > 0) out.push_back({-Box3::inf, 0, 0, true, false});
  out.insert(out.end(), crossings.begin(), crossings.end());
  if (winding_behind > 0) out.push_back({Box3::inf, 0, 0, false, false});
}

void emit_surface(std::vector<MeshCandidate>& candidates, double scale, int on_face, Spans& out) {
  Spans crossings;
  for (const MeshCandidate& c : candidates) {
    if (!c.is_hit) continue;
    const bool is_start = static_cast<int>(c.triangle) == on_face;
    const double t = is_start ? 0 : scale * c.t;
    crossings.push_back({t, is_start ? 0 : scale * bound_of(c.t, c.lo, c.hi), c.triangle, false, true});
  }
  std::sort(crossings.begin(), crossings.end(),
            [](const Crossing& a, const Crossing& b) { return a.t != b.t ? a.t < b.t : a.face < b.face; });
  if (!all_finite(crossings)) return;
  out.insert(out.end(), crossings.begin(), crossings.end());
}

void Mesh::spans_within(const LocalRay& ray, const LineWindow& window, Spans& out) const {
  const MeshLine line(ray, index_->bounds);
  const ClearCells::Place nowhere{-Box3::inf, 0}, anywhere{Box3::inf, 0};
  const auto before = index_->clear.find_before(line, window.begin / line.scale).value_or(nowhere);
  const auto behind = index_->clear.find_behind(line, window.end / line.scale).value_or(anywhere);
  const LineWindow part{before.t, behind.t};
  thread_local std::vector<MeshCandidate> candidates;
  candidates.clear();
  index_->walk(line, part, [&](std::uint32_t triangle) {
    MeshCandidate candidate;
    if (!find_candidate(line, *mesh, triangle, candidate)) return;
    if (lies_within(line, *mesh, part, candidate)) candidates.push_back(candidate);
  });
  if (candidates.empty() && before.winding <= 0) return;
  // Each once, in an order that does not depend on the structure.
  std::sort(candidates.begin(), candidates.end(),
            [](const MeshCandidate& a, const MeshCandidate& b) { return a.triangle < b.triangle; });
  const auto is_same = [](const MeshCandidate& a, const MeshCandidate& b) { return a.triangle == b.triangle; };
  candidates.erase(std::unique(candidates.begin(), candidates.end(), is_same), candidates.end());
  if (hull) return emit_surface(candidates, line.scale, ray.on_face, out);
  emit_solid(*mesh, candidates, line.scale, before.winding, behind.winding, ray.on_face, out);
}

}  // namespace tenon
