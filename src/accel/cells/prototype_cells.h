#pragma once

#include <memory>
#include <vector>

#include "accel/cells/cell_tree.h"
#include "csg/prototype.h"

namespace tenon::cells {

/// The cells of a part that is stored once, in its own frame; none where nothing is left of the part. Rays come into
/// them through the cells of the tree that an instance of it stands in (InstanceRay).
struct PrototypeCells {
  std::shared_ptr<const Prototype> prototype;
  CellTree cells;
};

/// Builds the cells of all prototypes of a scene, those within others included, each once, and has their trees refer to
/// one another.
/// @param tree   outlives what is built
/// @param scale  of the tree
/// @return those of the tree itself, by PrototypeId
std::vector<std::shared_ptr<const PrototypeCells>> build_prototype_cells(const CsgTree& tree, const CellScale& scale,
                                                                         const BuildSettings& settings);

/// The trees of all prototypes below a tree, each once.
std::vector<const CellTree*> trees_within(const CellTree& cells);

}  // namespace tenon::cells
