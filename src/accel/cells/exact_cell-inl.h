// What a ray meets in one cell, by the arithmetic of spans(). Included once for each instruction set.

#if defined(TENON_ACCEL_CELLS_EXACT_CELL_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef TENON_ACCEL_CELLS_EXACT_CELL_INL_H_
#undef TENON_ACCEL_CELLS_EXACT_CELL_INL_H_
#else
#define TENON_ACCEL_CELLS_EXACT_CELL_INL_H_
#endif

#include <hwy/highway.h>

#include <bit>
#include <new>

#include "accel/cells/cell_trace.h"
#include "accel/cells/chord-inl.h"
#include "accel/cells/crossing_group.h"
#include "accel/cells/torus_root-inl.h"
#include "primitive/dispatch.h"

HWY_BEFORE_NAMESPACE();
namespace tenon::cells {
namespace HWY_NAMESPACE {

enum class Outcome { passed, met, unsure };

/// A ray as it was asked, and lengths of the scene along it.
struct AskedRay {
  const RayQuery* query;
  double square, inverse_square, length;  ///< of its direction
  double near;                            ///< two resolutions (CellScale)
  double together;                        ///< CellScale::together
  /// Where it begins: at t = 0, but in the frame of an instance, where it comes from before.
  double begin = 0;
  const LocalRay* local = nullptr;  ///< the same with its errors, in the frame of an instance

  HWY_INLINE void Begin(const RayQuery& the_query, double direction_square, const CellScale& scale) {
    query = &the_query;
    square = direction_square;
    inverse_square = 1 / square;
    length = hn::Sqrt(square);
    const double slowness = length * inverse_square;
    near = 2 * scale.resolution * slowness;
    together = scale.together * slowness;
  }
  double resolution() const { return 0.5 * near; }
  HWY_INLINE RayLanes<One> lanes() const {
    const Vec3 &o = query->ray.origin, &d = query->ray.direction;
    return {{o.x, o.y, o.z}, {d.x, d.y, d.z}, square, inverse_square, resolution()};
  }
};

/// The exact chords of a cell's leaves, by place; infinite where a leaf is not met.
struct CellChords {
  double enter[Cell::most_tabled], leave[Cell::most_tabled];
  double enter_face[Cell::most_tabled], leave_face[Cell::most_tabled];

  void Put(std::uint32_t place, const Chord& chord) {
    constexpr double never = std::numeric_limits<double>::infinity();
    enter[place] = chord.hit ? chord.enter.t : never;
    leave[place] = chord.hit ? chord.leave.t : never;
    enter_face[place] = chord.enter.face;
    leave_face[place] = chord.leave.face;
  }
};

/// What faces that coincide are told by. The resolution and the scene's tolerance are those along the ray.
struct GroupLimits {
  double resolution, together;
  bool wants_faces;  ///< whether to keep all faces that coincide, as the classifier would
};

/// Calls body(value_of), where value_of(state) is the value of a cell's points in a state.
template <class Body>
HWY_INLINE auto WithValues(const CellStore& cells, const Cell& cell, const Body& body) {
  if (cell.values == Cell::Values::several) {
    const ValueTable values = cells.values_of(cell);
    return body([&](std::uint32_t state) { return values.value(state); });
  }
  const std::uint64_t table = cell.table;
  return body([table](std::uint32_t state) { return static_cast<std::uint32_t>(table >> state & 1); });
}

/// What crossings that change the value of a cell's points amount to.
/// @param after    the state behind them
/// @param face_at  face_at(place, entering) -> LeafFace: what is crossed of the leaf at a place
template <class ValueOf, class FaceAt>
void TellGroup(const CellStore& cells, const Cell& cell, const ValueOf& value_of, const CrossingGroup& group,
               std::uint32_t after, const FaceAt& face_at, const GroupLimits& limits, std::vector<Run>& runs,
               CellAnswer& answer) {
  const std::uint32_t faces = group.faces(value_of, after);
  const CrossingGroup::End shown = group.shown(value_of, after, faces);
  answer.t = group.first_change(value_of, after).t;
  answer.leaf_entering = shown.entering;
  answer.before = static_cast<std::uint8_t>(value_of(group.before(after)));
  answer.after = static_cast<std::uint8_t>(value_of(after));
  answer.surface = face_at(shown.place, shown.entering);
  if (!limits.wants_faces || std::popcount(faces) < 2) return;
  answer.run = static_cast<std::uint32_t>(runs.size());
  Run& run = runs.emplace_back();
  run.t = answer.t;
  run.bound = limits.resolution;
  run.surface = answer.surface;
  run.leaf_entering = answer.leaf_entering;
  run.before = cells.medium_of(cell, answer.before);
  run.after = cells.medium_of(cell, answer.after);
  run.owner = cells.owner_of(cell, run.after != medium_outside ? answer.after : answer.before).leaf;
  for (std::uint32_t left = faces; left != 0; left &= left - 1) {
    const auto place = static_cast<std::uint32_t>(std::countr_zero(left));
    run.faces.push_back(face_at(place, group.enters(place)));
  }
}

/// The same for crossings that were found one by one. @return false where they are not certainly one boundary
template <class FaceAt>
bool TellFoundGroup(const CellStore& cells, const Cell& cell, const CrossingGroup& group, std::uint32_t after,
                    const FaceAt& face_at, const GroupLimits& limits, std::vector<Run>& runs, CellAnswer& answer) {
  return WithValues(cells, cell, [&](const auto& value_of) {
    const double t = group.first_change(value_of, after).t;
    for (const CrossingGroup::End& end : group.all()) {
      if (!(std::fabs(end.t - t) <= limits.together)) return false;
    }
    // So it may be where the ray was taken to come into the cell between two of them.
    if (value_of(group.before(after)) == value_of(after)) return false;
    TellGroup(cells, cell, value_of, group, after, face_at, limits, runs, answer);
    return true;
  });
}

/// The first boundary of a ray, several faces of which may coincide.
template <class ValueOf>
Outcome MeetChords(const CellStore& cells, const Cell& cell, const ValueOf& value_of, const CellChords& chords,
                   double t_in, double t_out, const GroupLimits& limits, std::vector<Run>& runs, CellAnswer& answer) {
  constexpr double never = std::numeric_limits<double>::infinity();
  const double near = 2 * limits.resolution;
  double enter[Cell::most_tabled], leave[Cell::most_tabled], next[Cell::most_tabled];
  std::uint32_t state = 0;
  const std::uint32_t count = cell.leaf_count;
  for (std::uint32_t i = 0; i < count; ++i) {
    enter[i] = chords.enter[i];
    leave[i] = chords.leave[i];
    const bool inside = enter[i] <= t_in && t_in < leave[i];
    state |= static_cast<std::uint32_t>(inside) << i;
    next[i] = inside ? leave[i] : enter[i] > t_in ? enter[i] : never;
  }
  const std::uint32_t before = value_of(state);
  for (;;) {
    double t = next[0];
    for (std::uint32_t i = 1; i < count; ++i) t = std::min(t, next[i]);
    if (!(t <= t_out)) return Outcome::passed;
    // Crossings at the same double are one step: a change that is undone there is none.
    for (std::uint32_t i = 0; i < count; ++i) {
      if (next[i] != t) continue;
      state ^= 1U << i;
      next[i] = (state >> i & 1) != 0 ? leave[i] : never;
    }
    if (value_of(state) == before) continue;
    CrossingGroup group;
    if (!group.collect(count, enter, leave, t, near, limits.together)) return Outcome::unsure;
    const std::uint32_t after = group.after(state);
    if (value_of(after) == before) {
      group.skip(leave, next);
      state = after;
      continue;
    }
    const auto face_at = [&](std::uint32_t place, bool entering) {
      const double face = (entering ? chords.enter_face : chords.leave_face)[place];
      return LeafFace{cell.leaves[place], static_cast<std::uint32_t>(face)};
    };
    TellGroup(cells, cell, value_of, group, after, face_at, limits, runs, answer);
    return Outcome::met;
  }
}

/// Follows one ray through one cell after another, exactly. Here t is that of the ray as it was asked.
class ExactCell {
 public:
  /// @param ray  the one that is followed, from one Begin() to the next
  ExactCell(const CellTree& cells, const CsgTree& tree, const AskedRay& ray, CellScratch& scratch)
      : cells_(cells), tree_(tree), ray_(ray), scratch_(scratch) {}

  /// Begins a new ray.
  void Begin() { number_ = ++scratch_.ray; }
  /// Says which of the batch's the rays are that are begun from now on, or that they are not of it.
  void BeginOfBatch(std::size_t i) { batch_ray_ = i; }
  static constexpr std::size_t no_batch = ~std::size_t{0};

  /// The ray in the frame of a leaf, as spans() has it.
  Placement::MappedRay Map(LeafId leaf, int on_face) const {
    const Placement& placement = tree_[leaf].placement;
    if (ray_.local == nullptr) return placement.to_local(ray_.query->ray, tree_.tolerance.distance, on_face);
    return placement.to_local(LocalFrom(on_face));
  }

  /// The same in its place: to copy it would have to wait for what is written piece by piece.
  void MapInto(Placement::MappedRay& mapped, LeafId leaf, int on_face) const {
    ::new (&mapped) Placement::MappedRay(Map(leaf, on_face));
  }

  const AskedRay& ray() const { return ray_; }
  CellScratch& scratch() const { return scratch_; }

  /// Gives a boundary that was found by plain arithmetic the t and the face of spans(). @return whether it has them
  HWY_INLINE bool Finish(CellAnswer& answer) {
    const LeafId leaf = answer.surface.leaf;
    const int on_face = start_face(*ray_.query, leaf);
    const ShapeRef shape = cells_.shapes.of_leaf[leaf.get()];
    if (shape.kind() != ShapeKind::general && (shape.kind() != ShapeKind::torus || on_face < 0)) {
      const CrossingLanes<One> end = OneCrossing(shape, on_face, answer);
      if (!end.unsure && std::fabs(end.t - answer.t) <= ray_.near) {
        answer.t = end.t;
        answer.surface.face = static_cast<std::uint32_t>(end.face);
        return true;
      }
    }
    return FinishBySpans(on_face, answer);
  }

  /// The same for crossings that coincide, and change the value of the cell's points.
  /// @param about        where plain arithmetic has found them, from a start
  /// @param after        the state behind them
  /// @param wants_faces  whether to keep all faces that coincide, as the classifier would
  HWY_NOINLINE bool FinishGroup(const Cell& cell, const CrossingGroup& about, double start, std::uint32_t after,
                                bool wants_faces, CellAnswer& answer) {
    CrossingGroup group;
    std::array<std::uint32_t, Cell::most_tabled> faces{};
    for (const CrossingGroup::End& end : about.all()) {
      CellAnswer crossing;
      crossing.t = end.t + start;
      crossing.leaf_entering = end.entering;
      crossing.surface.leaf = cell.leaves[end.place];
      if (!Finish(crossing)) return false;
      group.add({crossing.t, end.place, end.entering});
      faces[end.place] = crossing.surface.face;
    }
    const auto face_at = [&](std::uint32_t place, bool) { return LeafFace{cell.leaves[place], faces[place]}; };
    const GroupLimits limits{ray_.resolution(), ray_.together, wants_faces};
    return TellFoundGroup(cells_, cell, group, after, face_at, limits, scratch_.runs, answer);
  }

  /// The first boundary in a cell whose leaves all have chords, several of which coincide there.
  /// @param wants_faces  whether to keep all faces that do, as the classifier would
  HWY_NOINLINE Outcome Meet(const Cell& cell, double t_in, double t_out, bool wants_faces, CellAnswer& answer) {
    const double near = ray_.near;
    CellChords chords;
    for (std::uint32_t i = 0; i < cell.leaf_count; ++i) {
      const ShapeRef shape = cells_.shapes.of_leaf[cell.leaves[i].get()];
      if (!has_chord(shape.kind())) return Outcome::unsure;
      const int on_face = start_face(*ray_.query, cell.leaves[i]);
      const Chord chord = FindChord(ray_.lanes(), cells_.shapes, shape, on_face, cells_.scale.reach, ray_.length);
      if (chord.unsure) return Outcome::unsure;
      chords.Put(i, chord);
      const bool is_clear =
          t_in - ray_.begin > near || StartIsClear(chords.enter[i], chords.leave[i], on_face, ray_.begin, near);
      if (!is_clear) return Outcome::unsure;
    }
    const GroupLimits limits{ray_.resolution(), ray_.together, wants_faces};
    return WithValues(cells_, cell, [&](const auto& value_of) {
      return MeetChords(cells_, cell, value_of, chords, t_in, t_out, limits, scratch_.runs, answer);
    });
  }

  /// Has the classifier follow the ray through the cell, with the bounds of all crossings.
  ///
  /// The cell's expression is right within 8 resolutions around the stretch (CellScale). A run that begins in it takes
  /// crossings at most two away, so none that lies further off has a part in it, as long as the bounds are no larger
  /// than the resolution.
  HWY_NOINLINE Outcome Resolve(const Cell& cell, double t_in, double t_out, CellAnswer& answer) {
    if (cell.extended && cells_.extended[cell.table].leaf_count > Cell::most_followed) return Outcome::unsure;
    if (!scratch_.classifier) scratch_.classifier.emplace(CellState{}, CellCrossings{}, cells_.most_leaves);
    CellClassifier& classifier = *scratch_.classifier;
    const std::span<const LeafId> leaves = cells_.leaves_of(cell);
    auto& lists = classifier.source().of_leaf;
    if (lists.size() < leaves.size()) lists.resize(leaves.size());
    const double near = 8 * ray_.resolution();
    const LineWindow window{t_in - near, t_out + near};
    const Vec3& direction = ray_.query->ray.direction;
    const Vec3 inverse{1 / direction.x, 1 / direction.y, 1 / direction.z};
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      lists[i].clear();
      if (!MayReach(tree_[leaves[i]].bounds, inverse, window)) continue;
      const Spans& known = FindSpans(leaves[i], start_face(*ray_.query, leaves[i]), window);
      for (const Crossing& c : known) {
        const bool matters = window.meets(c.t - c.bound, c.t + c.bound);
        if (c.surface || (matters && !(c.bound <= ray_.resolution()))) return Outcome::unsure;
      }
      lists[i] = known;
    }
    classifier.state().enter(cell, cells_);
    classifier.start();
    for (std::size_t i = 0; i < leaves.size(); ++i) classifier.reveal(LeafId{i});
    while (std::optional<Run> run = classifier.settle(std::numeric_limits<double>::infinity())) {
      if (run->t > t_out) break;
      if (!(run->t > t_in)) continue;
      answer.t = run->t;
      answer.leaf_entering = run->leaf_entering;
      run->surface.leaf = leaves[run->surface.leaf.get()];
      InlineVector<LeafFace, 4> faces;
      for (std::size_t i = 0; i < run->faces.size(); ++i) {
        faces.push_back({leaves[run->faces[i].leaf.get()], run->faces[i].face});
      }
      run->faces = faces;
      answer.surface = run->surface;
      answer.run = static_cast<std::uint32_t>(scratch_.runs.size());
      scratch_.runs.push_back(*run);
      return Outcome::met;
    }
    return Outcome::passed;
  }

  /// Whether the ray may come to a leaf with these bounds within a window.
  bool MayReach(const Box3& bounds, const Vec3& inverse, const LineWindow& window) const {
    const Vec3& origin = ray_.query->ray.origin;
    double first = window.begin, last = window.end;
    for (int axis = 0; axis < 3; ++axis) {
      const double low = (bounds.lower[axis] - cells_.margin - origin[axis]) * inverse[axis];
      const double high = (bounds.upper[axis] + cells_.margin - origin[axis]) * inverse[axis];
      // The ray runs along a plane that its origin lies in.
      if (std::isnan(low) || std::isnan(high)) continue;
      first = std::max(first, std::min(low, high));
      last = std::min(last, std::max(low, high));
    }
    return first <= last;
  }

  /// The first crossing behind a place of a leaf that tells them one after another.
  const NextCrossing& FindNext(LeafId leaf, double from) {
    if (batch_ray_ != no_batch) {
      if (const auto* const next = scratch_.batch_crossings.behind(leaf, batch_ray_, from)) return *next;
    }
    auto& known = scratch_.next_crossings[leaf.get() % CellScratch::known];
    if (known.ray != number_ || known.leaf != leaf) {
      known.ray = number_;
      known.leaf = leaf;
      MapInto(known.mapped, leaf, start_face(*ray_.query, leaf));
    } else if (known.holds_from(from)) {
      return known.next;
    }
    ++tests_;
    known.from = from;
    ::new (&known.next) NextCrossing(
        next_crossing(tree_.primitives, tree_[leaf].primitive, known.mapped, {ray_.begin, from, ray_.near}));
    return known.next;
  }

  /// Leaves whose spans() were asked since the last call.
  std::uint64_t TakeTests() { return std::exchange(tests_, 0); }

 private:
  // That of a leaf which plain arithmetic has found.
  HWY_INLINE CrossingLanes<One> OneCrossing(ShapeRef shape, int on_face, const CellAnswer& answer) const {
    const bool enters = answer.leaf_entering;
    const auto take = [&]<class Shape>(const HugePageVector<Shape>& list) {
      return SharedShape<One, Shape>(list[shape.index()]);
    };
    if (shape.kind() == ShapeKind::torus) {
      return TorusCrossing(One(), ray_.lanes(), take(cells_.shapes.tori), answer.t, enters);
    }
    return FindCrossing(One(), ray_.lanes(), cells_.shapes, shape.kind(), take, on_face, cells_.scale.reach,
                        ray_.length, enters, answer.t);
  }

  HWY_NOINLINE bool FinishBySpans(int on_face, CellAnswer& answer) {
    const LeafId leaf = answer.surface.leaf;
    const PrimitiveId primitive = tree_[leaf].primitive;
    const auto take = [&](const Crossing& c) {
      answer.t = c.t;
      answer.surface.face = c.face;
      return c.bound <= ray_.resolution();
    };
    if (has_crossing_near(tree_.primitives, primitive)) {
      ++tests_;
      const auto found =
          crossing_near(tree_.primitives, primitive, Map(leaf, on_face), answer.t, ray_.near, answer.leaf_entering);
      if (found) return take(*found);
    }
    const LineWindow window{answer.t - 2 * ray_.near, answer.t + 2 * ray_.near};
    for (const Crossing& c : FindSpans(leaf, on_face, window)) {
      if (c.entering == answer.leaf_entering && std::fabs(c.t - answer.t) <= ray_.near) return take(c);
    }
    return false;
  }

  // At least those within a window.
  const Spans& FindSpans(LeafId leaf, int on_face, const LineWindow& window) {
    auto& known = scratch_.mailbox[leaf.get() % CellScratch::known];
    const PrimitiveId primitive = tree_[leaf].primitive;
    if (known.ray != number_ || known.leaf != leaf) {
      known.ray = number_;
      known.leaf = leaf;
      MapInto(known.mapped, leaf, on_face);
      known.has_windows = window_share(tree_.primitives, primitive) < 1;
    } else if (!known.has_windows || (known.window.begin <= window.begin && window.end <= known.window.end)) {
      return known.spans;
    }
    ++tests_;
    known.spans.clear();
    known.window = window;
    spans_within(tree_.primitives, primitive, known.mapped, window, known.spans);
    return known.spans;
  }

  // The ray in the frame of an instance, as it starts on a face of a leaf, or -1.
  LocalRay LocalFrom(int on_face) const {
    LocalRay from = *ray_.local;
    from.on_face = on_face;
    return from;
  }

  // The start: of a leaf nothing but the face that the ray starts on may lie there.
  static bool StartIsClear(double enter, double leave, int on_face, double begin, double near) {
    const bool enters_here = std::fabs(enter - begin) <= near, leaves_here = std::fabs(leave - begin) <= near;
    if (on_face < 0) return !enters_here && !leaves_here;
    return enters_here != leaves_here && (enters_here ? enter : leave) == 0;
  }

  const CellTree& cells_;
  const CsgTree& tree_;
  const AskedRay& ray_;
  CellScratch& scratch_;
  std::uint64_t number_ = 0;  // of the ray in the scratch memory
  std::size_t batch_ray_ = no_batch;
  std::uint64_t tests_ = 0;
};

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#endif
