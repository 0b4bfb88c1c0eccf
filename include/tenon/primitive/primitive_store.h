#pragma once

#include <array>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "tenon/base/error.h"
#include "tenon/base/id.h"
#include "tenon/math/box3.h"
#include "tenon/math/vec3.h"
#include "tenon/primitive/choice.h"
#include "tenon/primitive/outline.h"
#include "tenon/primitive/polynomial_terms.h"
#include "tenon/primitive/triangle_mesh.h"

namespace tenon {

using PrimitiveId = Id<struct Primitive_>;

enum class Unit { none, length };

/// n·p <= d.
struct Plane {
  Vec3 normal;
  double d = 0;

  friend constexpr bool operator==(const Plane&, const Plane&) = default;
};

class CompositeSolid;

/// Shared by every primitive that is made of it, and never null in one.
using SharedMesh = std::shared_ptr<const TriangleMesh>;

/// Loops of corners, or rows of control points.
using PointLists = std::vector<std::vector<Vec3>>;
/// Nets of control points, each a list of rows.
using ControlNets = std::vector<PointLists>;

/// The value of one field of a primitive.
using FieldValue = std::variant<double, bool, Vec3, std::vector<Plane>, Outline, SharedMesh, Choice, Box3,
                                QuadricCoefficients, PolynomialTerms, PointLists, ControlNets>;

/// One parameter of a primitive: parser, printer and documentation derive from it.
struct FieldInfo {
  std::string_view name;
  Unit unit = Unit::none;
  FieldValue fallback;  ///< the value when none is given; its alternative is the field's type
  std::string_view doc;
};

/// One kind of primitive.
struct PrimitiveKind {
  std::string_view name;       ///< "sphere", "cone", ...: what statistics and hits print
  std::string_view scad_name;  ///< the module of the scene language that makes it, with these fields as arguments
  std::string_view doc;
  bool bounded = true;   ///< false for half-spaces
  bool surface = false;  ///< made as a surface, without inside, unless a field says that it is closed
  std::vector<FieldInfo> fields;
};

/// Owns the primitives of a scene, one vector per kind, in their local frames.
class PrimitiveStore {
 public:
  PrimitiveStore();
  PrimitiveStore(const PrimitiveStore&);
  PrimitiveStore(PrimitiveStore&&) noexcept;
  PrimitiveStore& operator=(const PrimitiveStore&) = delete;
  PrimitiveStore& operator=(PrimitiveStore&&) noexcept;
  ~PrimitiveStore();

  /// Every kind that a scene may name, in a fixed order.
  static std::span<const PrimitiveKind> kinds();
  /// The kind with this `PrimitiveKind::name`; nullptr when there is none.
  static const PrimitiveKind* find_kind(std::string_view name);

  /// Adds a primitive.
  /// @param kind    an element of kinds()
  /// @param values  one value per field, in the order of `kind.fields`, each of the alternative of its fallback
  /// @return its id, the same one for the same values, or an error (without place) that says why these values make no
  /// solid: a size that is zero,
  ///         negative or not finite
  Result<PrimitiveId> add(const PrimitiveKind& kind, std::span<const FieldValue> values);

  /// Adds a solid made of others, of the kind "instance", which no scene names and which has no fields.
  PrimitiveId add_instance(std::shared_ptr<const CompositeSolid> solid);

  /// Adds a copy of another store's primitive; what is shared by copies, such as a mesh, stays shared.
  PrimitiveId add_copy(const PrimitiveStore& from, PrimitiveId id);

  std::size_t size() const;
  const PrimitiveKind& kind(PrimitiveId id) const;
  /// The field values, as given to add().
  std::vector<FieldValue> values(PrimitiveId id) const;

  /// What the primitives are made of; for the dispatch unit only.
  struct Lists;
  const Lists& lists() const { return *lists_; }

 private:
  std::unique_ptr<Lists> lists_;
};

}  // namespace tenon
