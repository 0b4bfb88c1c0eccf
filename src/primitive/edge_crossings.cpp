#include "primitive/edge_crossings.h"

#include <algorithm>

namespace tenon {

namespace {

// Crossings whose intervals meet.
struct Cluster {
  std::size_t first, count;
  double lo, hi;
  bool sure;
};

class ClusterWalk {
 public:
  ClusterWalk(std::vector<EdgeCrossing>& crossings, const SearchedPart& part, FunctionRef<bool(double)> is_inside,
              std::vector<Cluster>& clusters)
      : crossings_(crossings), part_(part), is_inside_(is_inside), clusters_(clusters) {
    std::sort(crossings.begin(), crossings.end(), [](const EdgeCrossing& a, const EdgeCrossing& b) {
      return a.lo != b.lo ? a.lo < b.lo : a.edge < b.edge;
    });
    clusters.clear();
    for (std::size_t i = 0; i < crossings.size(); ++i) {
      const EdgeCrossing& c = crossings[i];
      if (clusters.empty() || c.lo > clusters.back().hi) {
        clusters.push_back({i, 1, c.lo, c.hi, c.sure});
        continue;
      }
      Cluster& cluster = clusters.back();
      ++cluster.count;
      cluster.hi = std::max(cluster.hi, c.hi);
      cluster.sure = cluster.sure && c.sure;
    }
  }

  bool run(std::vector<BoundaryCrossing>& found) {
    found.clear();
    bool all_sure = std::all_of(clusters_.begin(), clusters_.end(), [](const Cluster& c) { return c.sure; });
    const bool odd = crossings_.size() % 2 != 0;
    if (all_sure && odd && part_.outside_before && part_.outside_after) {
      // An error was larger than its bound; nothing is sure then.
      for (Cluster& cluster : clusters_) cluster.sure = false;
      all_sure = false;
    }
    const bool starts_inside = find_start(all_sure, odd);
    bool inside = starts_inside;
    for (std::size_t i = 0; i < clusters_.size(); ++i) {
      if (clusters_[i].sure) {
        report_each(clusters_[i], inside, found);
        inside ^= clusters_[i].count % 2 != 0;
      } else {
        const bool after = is_inside_behind(i);
        report_whole(clusters_[i], inside, after, found);
        inside = after;
      }
    }
    return starts_inside;
  }

 private:
  bool is_inside_between(double a, double b) { return is_inside_(0.5 * a + 0.5 * b); }

  bool is_inside_behind(std::size_t i) {
    const bool last = i + 1 == clusters_.size();
    if (last && part_.outside_after) return false;
    const double next = last ? part_.end : clusters_[i + 1].lo;
    return next > clusters_[i].hi ? is_inside_between(clusters_[i].hi, next) : is_inside_(part_.end);
  }

  bool find_start(bool all_sure, bool odd) {
    if (part_.outside_before) return false;
    if (all_sure && part_.outside_after) return odd;
    if (clusters_.empty()) return is_inside_between(part_.begin, part_.end);
    const Cluster& first = clusters_.front();
    if (first.lo > part_.begin) return is_inside_between(part_.begin, first.lo);
    // The part begins within an interval: from the gap behind it, if its parity is known.
    const double next = clusters_.size() > 1 ? clusters_[1].lo : part_.end;
    if (first.sure && next > first.hi) return is_inside_between(first.hi, next) != (first.count % 2 != 0);
    return is_inside_(part_.begin);
  }

  static BoundaryCrossing boundary(const EdgeCrossing& c, double lo, double hi, bool entering) {
    End end{{c.t, lo, hi}, face_of_edge(c.edge, c.rising, entering), c.given};
    if (c.given) end.lo = end.hi = end.t;
    return {end, entering};
  }

  void report_each(const Cluster& cluster, bool inside, std::vector<BoundaryCrossing>& found) {
    const auto begin = crossings_.begin() + static_cast<std::ptrdiff_t>(cluster.first);
    const auto end = begin + static_cast<std::ptrdiff_t>(cluster.count);
    std::sort(begin, end,
              [](const EdgeCrossing& a, const EdgeCrossing& b) { return a.t != b.t ? a.t < b.t : a.edge < b.edge; });
    for (auto c = begin; c != end; ++c) {
      found.push_back(boundary(*c, c->lo, c->hi, !inside));
      inside = !inside;
    }
  }

  // As many of the cluster's crossings as make up for the change of state, or one twice.
  void report_whole(const Cluster& cluster, bool before, bool after, std::vector<BoundaryCrossing>& found) {
    const auto begin = crossings_.begin() + static_cast<std::ptrdiff_t>(cluster.first);
    auto end = begin + static_cast<std::ptrdiff_t>(cluster.count);
    const bool fits = (cluster.count % 2 != 0) == (before != after);
    if (!fits && cluster.count > 1) {
      // Without one that is not sure, nor the start of the ray.
      std::iter_swap(
          std::min_element(begin, end, [](const EdgeCrossing& a, const EdgeCrossing& b) { return rank(a) < rank(b); }),
          end - 1);
      --end;
    }
    sort_by_place(begin, end);
    bool inside = before;
    for (auto c = begin; c != end; ++c) {
      found.push_back(boundary(*c, cluster.lo, cluster.hi, !inside));
      inside = !inside;
    }
    if (inside != after) found.push_back(boundary(*begin, cluster.lo, cluster.hi, !inside));
  }

  static int rank(const EdgeCrossing& c) { return c.given ? 2 : c.sure ? 1 : 0; }

  using Iterator = std::vector<EdgeCrossing>::iterator;
  static void sort_by_place(Iterator begin, Iterator end) {
    std::sort(begin, end,
              [](const EdgeCrossing& a, const EdgeCrossing& b) { return a.t != b.t ? a.t < b.t : a.edge < b.edge; });
  }

  std::vector<EdgeCrossing>& crossings_;
  const SearchedPart& part_;
  FunctionRef<bool(double)> is_inside_;
  std::vector<Cluster>& clusters_;
};

}  // namespace

bool find_boundary_crossings(std::vector<EdgeCrossing>& crossings, const SearchedPart& part,
                             FunctionRef<bool(double)> is_inside, std::vector<BoundaryCrossing>& found) {
  thread_local std::vector<Cluster> clusters;
  return ClusterWalk(crossings, part, is_inside, clusters).run(found);
}

std::optional<Crossing> crossing_between_caps(const Chord& slab, std::span<const EdgeCrossing> crossings, double t,
                                              double near, bool entering, std::uint32_t first_wall) {
  const double first = t - 2 * near, last = t + 2 * near;
  const End& cap = entering ? slab.enter : slab.leave;
  if (crossings.empty()) {
    const bool is_known = !cap.given && cap.lo >= first && cap.hi <= last;
    return is_known && std::fabs(cap.t - t) <= near ? std::optional(crossing_at(cap, entering)) : std::nullopt;
  }
  const EdgeCrossing& wall = crossings.front();
  const bool is_known = crossings.size() == 1 && wall.sure && !wall.given && wall.lo >= first && wall.hi <= last;
  const bool is_clear = entering ? cap.hi < wall.lo : cap.lo > wall.hi;
  if (!is_known || !is_clear || std::fabs(wall.t - t) > near) return std::nullopt;
  return crossing_at({{wall.t, wall.lo, wall.hi}, first_wall + face_of_edge(wall.edge, wall.rising, entering)},
                     entering);
}

void emit_between_caps(const Chord& slab, const std::vector<BoundaryCrossing>& boundary, bool inside,
                       std::uint32_t first_wall, Spans& out) {
  const std::size_t first = out.size();
  End enter = slab.enter;
  for (const BoundaryCrossing& c : boundary) {
    End end = c.end;
    end.face += first_wall;
    if (c.entering) {
      enter = later(slab.enter, end);
    } else {
      emit_chord({enter, earlier(slab.leave, end)}, out);
    }
    inside = c.entering;
  }
  if (inside) emit_chord({enter, slab.leave}, out);
  put_in_order(first, out);
}

}  // namespace tenon
