#pragma once

#include <array>
#include <deque>
#include <vector>

#include "accel/cells/split_plane.h"
#include "accel/cells/split_trials.h"
#include "accel/cells/subdivision.h"
#include "accel/cells/tabled_subdivider.h"

namespace tenon::cells {

/// A part of space under work: its expression, and the leaves that straddle it, in the order of the expression.
struct SpacePart {
  Box3 box;
  LocalExpression expression;
  std::vector<LeafId> leaves;
  int depth = 0;
  int in_vain = 0;  ///< splits in a row that left nearly all leaves in this part

  bool has_boundary() const { return !leaves.empty(); }
};

/// Subdivides parts of space in which any number of leaves have a boundary, down to those that TabledSubdivider takes
/// over. Its memory is reused from part to part.
class Subdivider {
 public:
  explicit Subdivider(const SubdivisionInput& input)
      : input_(input), tabled_(input), folder_(input.ranks), trials_(input.regions, input.ranks, input.scale.growth) {}

  /// Subdivides one part of space by itself.
  /// @param most_cells  when there are more, nothing is split any further
  Subdivision subdivide(const SpacePart& part, std::size_t most_cells, Subdivision::Built& root);

  /// Cuts a part in two.
  /// @return whether there is a plane worth trying; `parts` then tell which side has a boundary
  bool split(const SpacePart& part, std::array<SpacePart, 2>& parts);

  /// What is left of the expression in a part of the box.
  void restrict_to(const Box3& box, const SpacePart& whole, SpacePart& part);

 private:
  // Up to so many leaves a plane is priced by folding the expression on both sides; above, by the leaves' bounds.
  static constexpr std::size_t most_folded = 256;

  Subdivision::Built build(const SpacePart& part, std::size_t level);
  bool worth_splitting(const SpacePart& part) const;
  SplitPlane choose_plane(const SpacePart& part);
  void choose_by_bounds(const SpacePart& part, SplitPlane& best) const;
  double leaf_cost(const SpacePart& part) const;
  Box3 tight_box(const SpacePart& part) const;

  const SubdivisionInput& input_;
  TabledSubdivider tabled_;
  Subdivision result_;
  std::size_t most_cells_ = ~std::size_t{0};
  Folder folder_;
  SplitTrials trials_;
  std::vector<SplitPlane> planes_;               // to try
  std::deque<std::array<SpacePart, 2>> levels_;  // the two sides under work at each depth
};

}  // namespace tenon::cells
