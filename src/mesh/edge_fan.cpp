#include "mesh/edge_fan.h"

#include <algorithm>
#include <numeric>

#include "math/orientation.h"

namespace tenon {

void EdgeFan::add(const Triangle& triangle, const Vec3& apex) {
  const auto view = FlatView::of({from_, to_, apex});
  // A triangle without area bounds nothing.
  const int facing = view ? view->turn(triangle[0], triangle[1], triangle[2]) : 0;
  if (facing == 0) return;
  // Counterclockwise around the edge is where the normal of from, to, apex points.
  halves_.push_back({apex, facing == view->turn(from_, to_, apex) ? -1 : 1});
}

void EdgeFan::add_both_parts(const Triangle& triangle) {
  const auto view = FlatView::of(triangle);
  if (!view) return;
  for (const int side : {1, -1}) {
    const auto apex = std::find_if(triangle.begin(), triangle.end(),
                                   [&](const Vec3& p) { return view->turn(from_, to_, p) == side; });
    if (apex != triangle.end()) add(triangle, *apex);
  }
}

int EdgeFan::part_of(const Half& half) const {
  const Vec3& first = halves_.front().apex;
  if (const int side = orientation(to_, first, half.apex, from_)) return side > 0 ? 1 : 3;
  const auto view = FlatView::of({from_, to_, first});
  return view->turn(from_, to_, first) == view->turn(from_, to_, half.apex) ? 0 : 2;
}

bool EdgeFan::has_overlap() const {
  const int sum = std::accumulate(halves_.begin(), halves_.end(), 0,
                                  [](int so_far, const Half& half) { return so_far + half.change; });
  if (halves_.empty() || sum != 0) return false;
  struct Placed {
    const Half* half;
    int part;
  };
  std::vector<Placed> sorted;
  for (const Half& half : halves_) sorted.push_back({&half, part_of(half)});
  const auto comes_before = [this](const Placed& a, const Placed& b) {
    if (a.part != b.part || a.part % 2 == 0) return a.part < b.part;
    return orientation(to_, a.half->apex, b.half->apex, from_) > 0;
  };
  std::sort(sorted.begin(), sorted.end(), comes_before);
  int within = 0, least = 0, most = 0;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    within += sorted[i].half->change;
    if (i + 1 < sorted.size() && !comes_before(sorted[i], sorted[i + 1])) continue;
    least = std::min(least, within);
    most = std::max(most, within);
  }
  return most - least > 1;
}

}  // namespace tenon
