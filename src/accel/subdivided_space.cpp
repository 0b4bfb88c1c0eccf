#include "accel/subdivided_space.h"

#include "csg/enclosures.h"

namespace tenon {

SubdividedSpace::SubdividedSpace(const CsgTree& tree, const SpaceAxes& along)
    : axes(along), margin(enclosure_margin(tree)), projection(along.minimum_enclosures_of(tree), tree.has_media) {
  for (std::size_t i = 0; i < tree.leaves.size(); ++i) {
    const LeafId leaf{i};
    if (!projection.is_bounded(leaf)) continue;
    primitives.push_back(leaf);
    box = hull(box, projection.enclosure(leaf));
  }
  box = grown(box, margin);
}

SpaceAxes chosen_axes(bool eye, const ScreenView* view) {
  return eye && view != nullptr ? SpaceAxes::eye(*view) : SpaceAxes::world();
}

Levels take_levels(AcceleratorOptions& options, const std::string& key, int fallback, int highest) {
  const int all = options.take_integer(key, fallback, 0, highest);
  Levels levels{};
  for (std::size_t a = 0; a < 3; ++a) {
    levels[a] = options.take_integer(key + '_' + "xyz"[a], all, 0, highest);
  }
  return levels;
}

}  // namespace tenon
