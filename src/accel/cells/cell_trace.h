#pragma once

#include <algorithm>
#include <cstring>
#include <limits>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "accel/cells/batch_crossings.h"
#include "accel/cells/cell_tree.h"
#include "csg/classifier.h"
#include "primitive/next_crossing.h"
#include "tenon/accel/accelerator.h"
#include "tenon/base/function_ref.h"
#include "tenon/primitive/crossing.h"

namespace tenon::cells {

/// What is asked of a ray.
enum class Wanted : std::uint8_t {
  occlusion,  ///< whether there is a boundary
  boundary,   ///< the first, with the t, leaf and face of spans()
  hit,        ///< the same, with all its faces where several coincide
};

/// What a ray met among the cells.
struct CellAnswer {
  enum class Kind : std::uint8_t {
    nothing,   ///< no boundary before t_max
    boundary,  ///< certainly the first one, or for occluded() some one
    unsure,    ///< crossings too near to each other, or to the start: the exact structure has to say
  };

  double t = 0;  ///< see Wanted
  Kind kind = Kind::nothing;
  bool leaf_entering = false;  ///< the ray enters the leaf whose face it meets
  std::uint8_t before = 0;     ///< the values of the cell's points on the ray's side, unless there is a run
  std::uint8_t after = 0;      ///< and behind
  LeafFace surface;
  std::uint32_t cell = 0;
  static constexpr std::uint32_t no_run = ~std::uint32_t{0};
  std::uint32_t run = no_run;  ///< into CellScratch::runs, where several crossings had to be told apart
};

/// The expression of one cell, for the classifier; leaves by their place in the cell.
class CellState {
 public:
  /// @param cells  outlives its use
  void enter(const Cell& cell, const CellTree& cells) {
    cell_ = &cell;
    cells_ = &cells;
    symbols_ = cells.symbols_of(cell);
    values_ = cell.extended ? ValueTable{} : cells.values_of(cell);
    count_ = cells.leaves_of(cell).size();
  }
  void reset() { inside_.assign(count_, false); }
  void flip(LeafId leaf) { inside_[leaf.get()] = !inside_[leaf.get()]; }
  bool inside(LeafId leaf) const { return inside_[leaf.get()]; }

  /// What fills the point. Leaves that were folded away may own it, so those of the cell alone do not tell.
  MediumId medium() const {
    if (!cell_->extended) return cells_->medium_of(*cell_, table_value());
    const PointValue point = point_value();
    return point.value ? cells_->ranks.medium(point.owner) : medium_outside;
  }
  /// Who owns it; CellOwner::varying() for one that is not known.
  LeafId owner() const {
    if (!cell_->extended) return cells_->owner_of(*cell_, table_value()).leaf;
    const Owner owner = point_value().owner;
    if (owner.is_nobody()) return {};
    return cells_->ranks.is_certain(owner) ? cells_->ranks.leaf(owner) : CellOwner::varying().leaf;
  }

 private:
  std::uint32_t table_value() const {
    std::uint32_t state = 0;
    for (std::size_t i = 0; i < count_; ++i) state |= static_cast<std::uint32_t>(inside_[i]) << i;
    return values_.value(state);
  }
  PointValue point_value() const {
    // The leaves stand in the order of the symbols.
    std::size_t next = 0;
    return evaluate(symbols_, [&](LeafId) { return inside_[next++]; });
  }

  const Cell* cell_ = nullptr;
  const CellTree* cells_ = nullptr;
  ValueTable values_;
  std::span<const Symbol> symbols_;
  std::size_t count_ = 0;
  std::vector<bool> inside_;
};

/// The crossings with the leaves of one cell, as listed by the tracer.
struct CellCrossings {
  std::vector<Spans> of_leaf;

  void crossings(LeafId place, Spans& out) const {
    const Spans& known = of_leaf[place.get()];
    out.insert(out.end(), known.begin(), known.end());
  }
};

using CellClassifier = Classifier<CellState, CellCrossings>;

/// What a thread keeps from ray to ray.
struct CellScratch {
  struct KnownSpans {
    LeafId leaf;
    std::uint64_t ray = 0;
    Placement::MappedRay mapped;  ///< the ray in the leaf's frame
    LineWindow window;            ///< in which its crossings are known; of a primitive without windows all are
    bool has_windows = false;
    Spans spans;
  };
  struct KnownNext {
    LeafId leaf;
    std::uint64_t ray = 0;
    Placement::MappedRay mapped;
    double from = 0;
    NextCrossing next;  ///< behind `from`

    /// Whether it is the next behind another place, too.
    bool holds_from(double place) const {
      if (next.kind == NextCrossing::Kind::unsure) return place == from;
      return from <= place && (next.kind == NextCrossing::Kind::nothing || place < next.crossing.t);
    }
  };
  static constexpr std::size_t known = 64;

  /// A mailbox for leaves whose spans() is costly: found by the leaf's lowest bits.
  std::vector<KnownSpans> mailbox = std::vector<KnownSpans>(known);
  /// And one for those that tell their crossings one after another.
  std::vector<KnownNext> next_crossings = std::vector<KnownNext>(known);
  BatchCrossings batch_crossings;  ///< of the rays that are traced together
  std::uint64_t ray = 0;
  std::optional<CellClassifier> classifier;  ///< for as many leaves as any cell has
  std::vector<Run> runs;                     ///< of the tile; their owner may be CellOwner::varying()
};

/// The face of the leaf that the ray starts on, or -1.
inline int start_face(const RayQuery& query, LeafId leaf) {
  if (query.from == nullptr) return -1;
  const auto& faces = query.from->faces;
  for (std::size_t i = 0; i < faces.size(); ++i) {
    if (faces[i].leaf == leaf) return static_cast<int>(faces[i].face);
  }
  return -1;
}

/// Where the answers to rays are kept whole.
struct AnswerSink {
  std::span<CellAnswer> answers;

  static constexpr Wanted wanted = Wanted::hit;
  void put(std::size_t i, const CellAnswer& answer) const { answers[i] = answer; }
};

/// Where of each answer is kept what a RayBoundary says. An unsure one is none yet.
struct BoundarySink {
  std::span<RayBoundary> boundaries;
  std::vector<std::uint32_t>& unsure;  ///< rays, by their places
  const CellTree& cells;
  const std::vector<Run>& runs;  ///< of the scratch memory

  static constexpr Wanted wanted = Wanted::boundary;
  /// What RayBoundary says, where that is certain. @param t  infinite where there is no boundary before the ray's end
  void put_known(std::size_t i, double t, const LeafFace& surface, bool enters) const {
    RayBoundary& boundary = boundaries[i];
    boundary.t = t;
    boundary.surface = surface;
    boundary.entering = enters;
  }
  void put(std::size_t i, const CellAnswer& answer) const {
    const bool is_known = answer.kind == CellAnswer::Kind::boundary;
    put_known(i, is_known ? answer.t : std::numeric_limits<double>::infinity(), answer.surface,
              is_known && enters(answer));
    if (answer.kind == CellAnswer::Kind::unsure) unsure.push_back(static_cast<std::uint32_t>(i));
  }

 private:
  bool enters(const CellAnswer& answer) const {
    if (answer.run != CellAnswer::no_run) return runs[answer.run].after != medium_outside;
    return cells.medium_of(answer.cell, answer.after) != medium_outside;
  }
};

/// The same where only whether there is a boundary is asked.
struct OcclusionSink {
  std::span<std::uint8_t> occluded;
  std::vector<std::uint32_t>& unsure;

  static constexpr Wanted wanted = Wanted::occlusion;
  /// What may still be put another time: of rays from place i on, a bit each.
  void put_known(std::size_t i, std::size_t count, std::uint64_t met) const {
    for (std::size_t k = 0; k < count; k += 8, met >>= 8) {
      // Bits 0 to 6 each by the factor that brings it to its byte, and the last one by itself.
      const std::uint64_t bytes = (((met & 0x7f) * 0x02040810204081) & 0x01010101010101) | (met & 0x80) << 49;
      std::memcpy(occluded.data() + i + k, &bytes, std::min<std::size_t>(8, count - k));
    }
  }
  void put(std::size_t i, const CellAnswer& answer) const {
    occluded[i] = answer.kind == CellAnswer::Kind::boundary;
    if (answer.kind == CellAnswer::Kind::unsure) unsure.push_back(static_cast<std::uint32_t>(i));
  }
};

/// Follows rays with the widest instructions that the machine has: neighbours that go the same way together, the others
/// one by one. Every ray's answer is put once.
void trace_rays(const CellTree& cells, const CsgTree& tree, std::span<const RayQuery> queries, const AnswerSink& sink,
                CellScratch& scratch, TraversalStatistics& statistics);
void trace_rays(const CellTree& cells, const CsgTree& tree, std::span<const RayQuery> queries, const BoundarySink& sink,
                CellScratch& scratch, TraversalStatistics& statistics);
void trace_rays(const CellTree& cells, const CsgTree& tree, std::span<const RayQuery> queries,
                const OcclusionSink& sink, CellScratch& scratch, TraversalStatistics& statistics);

/// Takes a boundary; returns whether to go on.
using TellBoundary = FunctionRef<bool(const CellAnswer&)>;

/// Follows a ray through all its boundaries before t_max, the nearest first, until `tell` does not go on.
/// @return false where some that follow the last one told are left to the exact structure
bool trace_all(const CellTree& cells, const CsgTree& tree, const RayQuery& query, TellBoundary tell,
               CellScratch& scratch, TraversalStatistics& statistics);

}  // namespace tenon::cells
