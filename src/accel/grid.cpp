#include <algorithm>
#include <cmath>

#include "accel/all.h"
#include "accel/cell_lists.h"
#include "accel/grid_steps.h"
#include "accel/structure.h"

namespace tenon {

namespace {

enum class Step { classic, amanatides };

/// Bouatouch, course, "Subdivision into a 3D uniform grid", with its two ways to the next cell.
///
/// Where the course leaves something open: objects are sought by their minimum enclosures. When no resolution is
/// chosen, cells are about cubes and there are `density` for each primitive. A grid whose lists would hold more than 32
/// entries for each primitive (and 2^20) is halved until they do not: primitives that all lie in one place are
/// separated by no grid. The course has no mailboxes: `mailbox=off` shows what that costs.
class Grid {
 public:
  struct Scratch {};

  Grid() = default;
  Grid(const std::vector<EnclosedLeaf>& leaves, const Box3& space, CellIndex count, Step step, bool mailbox)
      : step_(step), mailbox_(mailbox) {
    const std::size_t most_entries = (std::size_t{1} << 20) + 32 * leaves.size();
    grid_ = {space, count};
    while (CellLists::count_entries(grid_, leaves) > most_entries && count != CellIndex{1, 1, 1}) {
      for (std::uint32_t& n : count) n = (n + 1) / 2;
      grid_ = {space, count};
    }
    lists_ = {grid_, leaves};
    filled_ = true;
  }

  void traverse(Walk& walk, Scratch&) const {
    if (!filled_) return;
    walk.use_mailbox(mailbox_);
    if (step_ == Step::classic) {
      trace(walk, ClassicSteps(grid_, walk.ray()));
    } else {
      trace(walk, AmanatidesSteps(grid_, walk.ray()));
    }
  }

  std::size_t memory_bytes() const { return lists_.memory_bytes(); }
  std::size_t boxes() const { return filled_ ? std::size_t{grid_.count(0)} * grid_.count(1) * grid_.count(2) : 0; }
  int depth() const { return filled_ ? 1 : 0; }

 private:
  template <class Steps>
  void trace(Walk& walk, Steps steps) const {
    if (!steps.enter()) return;
    for (;;) {
      ++walk.counters().cells_visited;
      for (const LeafId leaf : lists_.of(steps.cell())) walk.reveal(leaf);
      if (walk.settle(steps.exit())) return;
      ++walk.counters().next_box_calls;
      if (!steps.next()) return;
    }
  }

  GridGeometry grid_;
  CellLists lists_;
  Step step_ = Step::amanatides;
  bool mailbox_ = true;
  bool filled_ = false;
};

constexpr std::uint32_t most_cells_per_axis = 1024;
constexpr std::size_t most_cells = std::size_t{1} << 24;

// Cells that are about cubes, `wanted` of them all together. An axis shorter than a cell has one, and the others share
// out the number again.
CellIndex cubes(const Vec3& size, double wanted) {
  CellIndex count{};
  std::array<bool, 3> flat{};
  double edge = 0;
  for (bool settled = false; !settled;) {
    double volume = 1;
    int axes = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      if (flat[a]) continue;
      volume *= size[static_cast<int>(a)] / size[static_cast<int>(0)];
      ++axes;
    }
    edge = axes == 0 ? 0 : std::pow(volume / wanted, 1.0 / axes);
    settled = true;
    for (std::size_t a = 0; a < 3; ++a) {
      if (flat[a] || !(size[static_cast<int>(a)] / size[0] < edge)) continue;
      flat[a] = true;
      settled = false;
    }
  }
  for (std::size_t a = 0; a < 3; ++a) {
    const double n = flat[a] ? 1 : size[static_cast<int>(a)] / size[0] / edge;
    count[a] = n < most_cells_per_axis ? std::max(1u, static_cast<std::uint32_t>(n)) : most_cells_per_axis;
  }
  return count;
}

}  // namespace

Result<std::unique_ptr<Accelerator>> build_grid(const BuildInput& input, AcceleratorOptions& options) {
  const Step step = options.take_word("step", {"amanatides", "classic"}) == 1 ? Step::classic : Step::amanatides;
  const double density = options.take_number("density", 4, 0x1p-10, 1024);
  const int all = options.take_integer("resolution", 0, 0, most_cells_per_axis);
  CellIndex chosen{};
  for (std::size_t a = 0; a < 3; ++a) {
    chosen[a] =
        static_cast<std::uint32_t>(options.take_integer(std::string("n") + "xyz"[a], all, 0, most_cells_per_axis));
  }
  const bool mailbox = options.take_switch("mailbox", true);
  if (Status status = options.finish(); !status) return status.error();

  Grid grid;
  const std::vector<EnclosedLeaf> leaves = enclosed_leaves(input.tree);
  if (!leaves.empty()) {
    const Box3 space = hull_of(leaves, enclosure_margin(input.tree));
    const double wanted = std::min(density * static_cast<double>(leaves.size()), static_cast<double>(most_cells));
    CellIndex count = cubes(space.size(), wanted);
    for (std::size_t a = 0; a < 3; ++a) {
      if (chosen[a] > 0) count[a] = chosen[a];
    }
    const std::size_t cells = std::size_t{count[0]} * count[1] * count[2];
    if (cells > most_cells) {
      return Error{ErrorKind::usage,
                   "grid: " + std::to_string(cells) + " cells are more than the " + std::to_string(most_cells) +
                       " it may have; choose a smaller resolution",
                   {}};
    }
    grid = Grid(leaves, space, count, step, mailbox);
  }
  return std::unique_ptr<Accelerator>(std::make_unique<StructureAccelerator<Grid>>(input.tree, std::move(grid)));
}

}  // namespace tenon
