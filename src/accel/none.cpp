#include "accel/all.h"
#include "accel/structure.h"

namespace tenon {

namespace {

/// No structure: every bounded primitive is revealed, and the ray settled at once (Roth 1982, "Ray casting for modeling
/// solids"). What the others are checked against.
class None {
 public:
  struct Scratch {};

  explicit None(const CsgTree& tree) {
    for (std::size_t i = 0; i < tree.leaves.size(); ++i) {
      if (tree.leaves[i].bounds.is_bounded()) leaves_.emplace_back(i);
    }
  }

  void traverse(Walk& walk, Scratch&) const {
    for (const LeafId leaf : leaves_) walk.reveal(leaf);
  }

  std::size_t memory_bytes() const { return leaves_.size() * sizeof(LeafId); }
  std::size_t boxes() const { return 0; }
  int depth() const { return 0; }

 private:
  std::vector<LeafId> leaves_;
};

}  // namespace

Result<std::unique_ptr<Accelerator>> build_none(const BuildInput& input, AcceleratorOptions& options) {
  if (Status status = options.finish(); !status) return status.error();
  return std::unique_ptr<Accelerator>(std::make_unique<StructureAccelerator<None>>(input.tree, None(input.tree)));
}

}  // namespace tenon
