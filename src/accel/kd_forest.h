#pragma once

#include <cstdint>
#include <vector>

#include "accel/operation_tree.h"
#include "csg/enclosures.h"
#include "kdtree/kd_tree.h"

namespace tenon {

/// The kd-trees of the multiple kd-tree method (Zajíček 2012, §2.3): one for each operand of every intersection and
/// difference, and the one that encloses all. To the tree above it such an operation is a primitive.
///
/// Items are nodes of the operation tree: leaves, intersections and differences. Unions and complements eliminate no
/// crossing, so their operands join the tree above them. The subtracted operands of a difference are one operand, their
/// union, as in the binary trees of the thesis.
class KdForest {
 public:
  struct Operand {
    std::uint32_t tree = 0;
    bool needed = false;  ///< the operation is empty where a ray meets nothing in this tree
  };
  /// The operands of an operation: a stretch of operands().
  struct Operation {
    std::uint32_t first_operand = 0;
    std::uint32_t operand_count = 0;
  };

  KdForest(const CsgTree& tree, const OperationTree& operations, const KdOptions& options);

  const KdTree& enclosing_tree() const { return trees_.front(); }
  const std::vector<KdTree>& trees() const { return trees_; }
  const std::vector<Operand>& operands() const { return operands_; }
  /// By node of the operation tree; no operands where the node is no intersection or difference.
  const std::vector<Operation>& operations() const { return operations_; }
  std::size_t memory_bytes() const;

 private:
  void find_boxes(const CsgTree& tree, const OperationTree& operations);
  void add_operand(const OperationTree& operations, std::uint32_t first, std::uint32_t last, bool needed);
  void add_tree(const OperationTree& operations, std::uint32_t first, std::uint32_t last);

  KdOptions options_;
  std::vector<KdTree> trees_;
  std::vector<Operand> operands_;
  std::vector<Operation> operations_;
  // While building: of each node, its box and the cost of all leaves below it.
  std::vector<Box3> boxes_;
  std::vector<double> costs_;
};

}  // namespace tenon
