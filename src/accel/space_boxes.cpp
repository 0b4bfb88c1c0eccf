#include "accel/space_boxes.h"

#include <algorithm>

namespace tenon {

void SpaceBoxes::reserve(const std::vector<MidpointBox>& boxes) {
  std::size_t primitives = 0;
  for (const MidpointBox& box : boxes) primitives += box.primitives;
  leaves_.reserve(leaves_.size() + primitives);
  boxes_.reserve(boxes_.size() + boxes.size());
  if (filters_) spheres_.reserve(boxes_.capacity());
}

SpaceBoxes::Number SpaceBoxes::add(const MidpointBox& box, Projection& projection) {
  const CellRange cells = box.cells(levels_);
  const auto first = static_cast<std::uint32_t>(leaves_.size());
  for (const SubtreeToken& token : box.subtree) {
    if (token.is_leaf() && projection.is_bounded(token.leaf())) leaves_.push_back(token.leaf());
  }
  boxes_.push_back({cells, first, static_cast<std::uint32_t>(leaves_.size()) - first});
  depth_ = std::max(depth_, box.level[0] + box.level[1] + box.level[2]);
  if (filters_) {
    const Box3 enclosure = projection.enclose(box.subtree, grown(grid_.box(cells), margin_));
    spheres_.push_back(enclosure.is_empty() ? EnclosingSphere() : EnclosingSphere(enclosure, margin_));
    if (rectangles_) rectangles_->add(enclosure);
  }
  return static_cast<Number>(boxes_.size() - 1);
}

}  // namespace tenon
