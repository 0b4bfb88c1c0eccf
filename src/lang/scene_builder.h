#pragma once

#include <vector>

#include "tenon/scene/model.h"

namespace tenon::lang {

/// What a statement makes: nothing, all of space, or a node of the scene graph. So empty operands fold away as they
/// appear, and every node of the graph holds something.
struct Solid {
  enum class Extent { nothing, everything, node };

  Extent extent = Extent::nothing;
  SceneNodeId node;
  bool flat = false;  ///< a shape of the plane (flat_shapes.h)

  static Solid nothing() { return {}; }
  static Solid everything() { return {Extent::everything, {}, false}; }
  static Solid of(SceneNodeId id, bool flat = false) { return {Extent::node, id, flat}; }

  bool is_nothing() const { return extent == Extent::nothing; }
  bool is_everything() const { return extent == Extent::everything; }
};
using Solids = std::vector<Solid>;

/// Whether parts are shapes of the plane: the first that is something tells.
bool are_flat(const Solids& parts);

/// Builds the model, bottom up.
class SceneBuilder {
 public:
  /// Beyond this many nodes (2 GiB of them) a scene is taken for a mistake.
  static constexpr std::size_t most_nodes = std::size_t{1} << 24;

  Solid unite(const Solids& parts);
  Solid intersect(const Solids& parts);
  /// The first part without the others.
  Solid subtract(const Solids& parts);
  /// Everything outside the union of the parts.
  Solid complement(const Solids& parts);
  /// The union of the parts under a transform or an attribute.
  Solid wrap(const Transform& transform, const Solids& parts) { return wrap_any(transform, parts); }
  Solid wrap(const ColorAttribute& color, const Solids& parts) { return wrap_any(color, parts); }
  Solid wrap(const MaterialAttribute& material, const Solids& parts) { return wrap_any(material, parts); }
  Solid wrap(const CutFacesAttribute& cut_faces, const Solids& parts) { return wrap_any(cut_faces, parts); }
  Solid leaf(PrimitiveId primitive);

  /// The id of a material equal to this one.
  MaterialId intern(const Material& material);

  Model& model() { return model_; }
  const Model& model() const { return model_; }

 private:
  template <class Content>
  Solid wrap_any(const Content& content, const Solids& parts);
  Solid add(SceneNode node, bool flat);

  Model model_;
};

}  // namespace tenon::lang
