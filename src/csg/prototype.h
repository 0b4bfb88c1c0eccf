#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "csg/csg_tree.h"
#include "csg/expression.h"
#include "primitive/box_clip.h"
#include "primitive/composite_solid.h"
#include "primitive/mesh_bvh.h"

namespace tenon {

/// A subtree of the scene that stands at many places and is stored once: a tree in a frame of its own, met as one
/// solid.
///
/// Along a ray it has the crossings that its runs amount to (Classifier), with their bounds; the errors of the ray, and
/// with them the tolerance of the scene, are in the bounds of its leaves. A face of it is a face of a leaf, and whether
/// the solid lies on the other side of it than the leaf does.
class Prototype final : public CompositeSolid {
 public:
  /// @return none where the tree cannot be met as one solid: it has no end, or faces that cannot be counted
  static std::shared_ptr<Prototype> create(CsgTree tree);

  const CsgTree& tree() const { return tree_; }
  /// For who resolves the leaves' materials; nothing else may change.
  CsgTree& tree() { return tree_; }

  /// Of the box around it.
  double support(const Vec3& n) const override { return box_support(enclosure_, n); }
  void spans(const LocalRay& ray, Spans& out) const override;
  Region classify(const LocalBox& box) const override;
  Vec3 normal(const Vec3& point, std::uint32_t face) const override;
  std::uint32_t face_count() const override { return 2 * first_face_.back(); }

  /// A face of it, as one of a leaf.
  struct Face {
    LeafId leaf;
    std::uint32_t face;
    bool opposite;  ///< the solid lies on the other side than the leaf
  };
  Face face_of(std::uint32_t number) const;
  std::uint32_t number_of(const Face& face) const;

  /// The material that a face shows at a point of it; none where no leaf says.
  MaterialId face_material(const Vec3& point, std::uint32_t face) const;
  /// The material of the leaf that owns a point; none where no leaf says. At a surface that of the solid beside it.
  MaterialId material_at(const Vec3& point) const;

 private:
  class Source;
  class Scratch;

  Prototype(CsgTree tree, const Box3& enclosure, std::vector<std::uint32_t> first_face);
  bool knows_materials() const;
  Scratch& scratch() const;

  CsgTree tree_;
  bool knows_materials_;  // some leaf has one of its own
  Expression expression_;
  Box3 enclosure_;
  std::vector<std::uint32_t> first_face_;  // of each leaf, and behind the last
  std::vector<LeafId> boxed_;              // in the order of hierarchy_
  std::vector<LeafId> unbounded_;
  Box3 bounds_;  // of the hierarchy
  MeshBvh hierarchy_;
  std::shared_ptr<const char> life_;  // ends with the prototype, which threads keep scratch memory for
};

/// The prototype that a leaf is an instance of; nullptr for a primitive.
const Prototype* prototype_of(const CsgTree& tree, const Leaf& leaf);

/// The material of a face at a point of the world, where nothing but the leaf itself says it.
MaterialId face_material(const CsgTree& tree, const LeafFace& surface, const Vec3& point);

/// The material of a point of the world that a leaf owns.
MaterialId owner_material(const CsgTree& tree, LeafId owner, const Vec3& point);

}  // namespace tenon
