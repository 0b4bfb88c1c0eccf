#pragma once

#include <variant>
#include <vector>

#include "tenon/base/error.h"
#include "tenon/base/hash_index.h"
#include "tenon/base/id.h"
#include "tenon/math/affine3.h"
#include "tenon/math/color.h"
#include "tenon/primitive/primitive_store.h"

namespace tenon {

using SceneNodeId = Id<struct SceneNode_>;
using MaterialId = Id<struct Material_>;

/// A Boolean operation on the node's children. A difference subtracts every child after the first from the first; a
/// complement is everything outside the union of its children.
enum class SetOperation { union_, intersection, difference, complement };

/// A transformation of the union of the node's children.
struct Transform {
  Affine3 parent_from_child;
};

/// OpenSCAD's `color`: the outermost one applies to a primitive.
struct ColorAttribute {
  Rgba color;
};

/// Tenon's `material`: the one nearest to a primitive applies (Zajíček 2012, §1.2.2).
struct MaterialAttribute {
  MaterialId material;
};

/// Whose material the faces show that a subtracted solid leaves in another.
enum class CutFaces {
  tool,  ///< the subtracted solid's, where it was given one; else as `base`
  base,  ///< that of the solid that was cut
};

/// The one nearest to a subtracted primitive applies; CutFaces::tool where there is none.
struct CutFacesAttribute {
  CutFaces show = CutFaces::tool;
};

/// A leaf.
struct PrimitiveLeaf {
  PrimitiveId primitive;
};

/// A node of the semantic scene graph (Zajíček 2012, §1.2.2): operations, attributes, primitives.
struct SceneNode {
  std::variant<SetOperation, Transform, ColorAttribute, MaterialAttribute, CutFacesAttribute, PrimitiveLeaf> content =
      SetOperation::union_;
  std::vector<SceneNodeId> children;  ///< empty for a leaf; a node may be the child of several parents
};

/// The scene as it was modelled. Nodes live in one array, so that no depth of nesting needs a deep call stack; a node's
/// children come before it in the array. What occurs more than once is there once.
class SceneGraph {
 public:
  PrimitiveStore primitives;
  std::vector<SceneNode> nodes;
  SceneNodeId root;  ///< none for an empty scene

  const SceneNode& operator[](SceneNodeId id) const { return nodes[id.get()]; }
  /// @return the node, or the one like it that there is: the same to the last bit, with the same children
  SceneNodeId add(SceneNode node);

 private:
  HashIndex index_;
};

}  // namespace tenon
