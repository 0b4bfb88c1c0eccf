#pragma once

#include "csg/classifier.h"
#include "csg/csg_tree.h"
#include "primitive/dispatch.h"
#include "tenon/math/ray.h"

namespace tenon {

/// The leaves of a CSG tree as a classifier sees them, for one ray at a time.
class TreeSource {
 public:
  explicit TreeSource(const CsgTree& tree) : tree_(&tree) {}

  /// @param from  the hit the ray starts at; nullptr in free space
  void set_ray(const Ray& ray, const Hit* from) {
    ray_ = ray;
    from_ = from;
  }

  void crossings(LeafId id, Spans& out) const {
    const Leaf& leaf = (*tree_)[id];
    spans(tree_->primitives, leaf.primitive, leaf.placement, ray_, tree_->tolerance.distance, start_face(id), out);
  }
  bool has_media() const { return tree_->has_media; }
  MediumId medium(LeafId id) const { return (*tree_)[id].medium; }
  double priority(LeafId id) const { return (*tree_)[id].priority; }

 private:
  // The face of the leaf that the ray starts on, or -1.
  int start_face(LeafId id) const {
    if (from_ == nullptr) return -1;
    for (std::size_t i = 0; i < from_->faces.size(); ++i) {
      if (from_->faces[i].leaf == id) return static_cast<int>(from_->faces[i].face);
    }
    return -1;
  }

  const CsgTree* tree_;
  Ray ray_;
  const Hit* from_ = nullptr;
};

using TreeClassifier = Classifier<class ExpressionState, TreeSource>;

}  // namespace tenon
