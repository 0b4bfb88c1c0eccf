#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "tenon/csg/hit.h"
#include "tenon/primitive/crossing.h"

namespace tenon {

/// Where a ray crosses the leaves.
template <class S>
concept LeafSource = requires(S& source, LeafId leaf, Spans& spans) {
  source.crossings(leaf, spans);  // appends the crossings of the current ray with the leaf, sorted
};

/// And what fills them.
template <class S>
concept MediumSource = LeafSource<S> && requires(S& source, LeafId leaf) {
  { source.has_media() } -> std::convertible_to<bool>;
  { source.medium(leaf) } -> std::convertible_to<MediumId>;
  { source.priority(leaf) } -> std::convertible_to<double>;
};

/// Which leaves hold the point that a ray has come to.
template <class E>
concept LeafStates = requires(E& state, const E& seen, LeafId leaf) {
  state.reset();
  state.flip(leaf);
  { seen.inside(leaf) } -> std::same_as<bool>;
};

/// Which points of space an expression over the leaves holds: ExpressionState is the model.
template <class E>
concept ExpressionEvaluation = LeafStates<E> && requires(const E& seen, LeafId leaf) {
  { seen.value() } -> std::same_as<bool>;
  { seen.owns(leaf) } -> std::same_as<bool>;
};

/// The same by somebody who knows what fills each point, and who owns it.
template <class E>
concept MediumEvaluation = LeafStates<E> && requires(const E& seen) {
  { seen.medium() } -> std::same_as<MediumId>;
  { seen.owner() } -> std::same_as<LeafId>;
};

/// A change of the root along the ray: one boundary of the solid, however many faces coincide there.
struct Run {
  double t = 0;
  double bound = 0;
  LeafFace surface;            ///< the face that shows
  bool leaf_entering = false;  ///< the ray enters the leaf that shows
  bool is_surface = false;     ///< that leaf is a surface, not a solid
  LeafId owner;                ///< the leaf whose material fills the solid's side; none when nothing owns it
  MediumId before = medium_outside;
  MediumId after = medium_outside;
  InlineVector<LeafFace, 4> faces;  ///< every face that coincides here, and matters before the run or after it
};

/// Follows one ray through a Boolean expression. The rules for ties, runs, starts on a surface, surfaces and media
/// stand here and nowhere else.
///
/// Crossings are taken in the order (t, leaf), and the root is evaluated after each.
///
/// *Runs.* A run begins at a change of the root and takes every later change whose error interval meets the first
/// one's, up to the first change that does not. Intervals are not chained: a crossing that does not change the root
/// never joins two faces. When the root is the same before and after a run, nothing happened.
///
/// Every interval contains the exact crossing (Crossing), so the intervals of faces that coincide in the scene all
/// share a point and meet pairwise, at any rotation and in whatever order rounding put them: coincident faces form one
/// run.
///
/// *What shows.* Of the crossings whose interval meets the run's first, those whose bit alone changes the root in the
/// state before or after all of them; of these the first in tree order.
///
/// *Start.* The ray starts at t = 0, or where start() is told. Crossings at or before it give the state there. From
/// there on, changes of the root whose interval contains it are absorbed by the start, up to the first that does not.
///
/// *Surfaces.* A surface never flips a bit. It shows where the root would differ between its bit set and cleared.
///
/// *Media.* Where the source has media, the root's value is the medium of the leaf that owns the point: the one of
/// highest priority, then the first in tree order, among the leaves that hold the point, are not subtracted nor taken
/// from what is, and have every operation above them true. A MediumEvaluation has worked that out beforehand.
template <LeafStates State, LeafSource Source>
requires MediumEvaluation<State> ||(ExpressionEvaluation<State>&& MediumSource<Source>)class Classifier {
 public:
  Classifier(State state, Source source, std::size_t leaf_count)
      : state_(std::move(state)), source_(std::move(source)), revealed_(leaf_count), inside_place_(leaf_count) {}

  Source& source() { return source_; }
  State& state() { return state_; }

  /// Begins a new ray. The source must know it by now.
  /// @param begin  where it starts: 0, or -inf for its whole line
  void start(double begin = 0) {
    if (++stamp_ == 0) {
      std::fill(revealed_.begin(), revealed_.end(), 0);
      stamp_ = 1;
    }
    state_.reset();
    queue_.clear();
    trail_.clear();
    inside_.clear();
    started_ = false;
    absorbing_ = true;
    run_active_ = false;
    front_ = begin_ = begin;
    value_ = evaluate();
  }

  /// Whether the leaf was intersected with this ray already: the mailbox.
  bool revealed(LeafId leaf) const { return revealed_[leaf.get()] == stamp_; }

  /// Intersects a leaf with the ray, once per ray: crossings behind the settled front set its bit silently, the others
  /// wait for settle().
  /// @return whether it was intersected now, and not before
  bool reveal(LeafId leaf) {
    if (revealed(leaf)) return false;
    revealed_[leaf.get()] = stamp_;
    spans_.clear();
    source_.crossings(leaf, spans_);
    if (spans_.empty()) return true;

    bool inside = false;
    for (std::uint32_t i = 0; i < spans_.size(); ++i) {
      const Crossing& c = spans_[i];
      const bool passed = started_ ? c.t < front_ : c.t <= begin_;
      if (passed) {
        if (!c.surface) inside = !inside;
      } else if (c.t < std::numeric_limits<double>::infinity()) {
        queue_.push_back({c.t, c.bound, leaf, c.face, i, c.entering, c.surface});
        std::push_heap(queue_.begin(), queue_.end(), later);
      }
    }
    if (inside) {
      const MediumId before = value_;
      flip(leaf);
      if (started_ && value_ != before) ++seam_faults_;
    }
    return true;
  }

  /// Intersects a leaf that was revealed, and drops what comes of it: the cost of a structure without mailboxes.
  void intersect_again(LeafId leaf) {
    spans_.clear();
    source_.crossings(leaf, spans_);
  }

  /// Processes the crossings before `limit`. Every leaf that can change the root before it must have been revealed.
  /// @return the first run that lies wholly before the limit; none when there is none, and then the front is at `limit`
  std::optional<Run> settle(double limit) {
    started_ = true;
    for (;;) {
      if (queue_.empty() || !(queue_.front().t < limit)) {
        if (run_active_ && run_ends_before(limit)) {
          if (std::optional<Run> run = close_run()) return run;
        }
        front_ = std::max(front_, limit);
        return std::nullopt;
      }
      const Event e = pop();
      front_ = e.t;
      const MediumId before = value_;
      const bool changes = e.surface ? shows_surface(e.leaf) : (flip(e.leaf), value_ != before);
      trail_.push_back(e);
      if (!changes) continue;
      if (absorbing_ && e.t - e.bound <= begin_) continue;
      absorbing_ = false;
      if (run_active_ && e.t - e.bound <= run_high_) {
        run_shows_surface_ |= e.surface;
        end_run_here();
        continue;
      }
      std::optional<Run> run;
      if (run_active_) run = close_run();
      begin_run(e, before);
      if (run) return run;
    }
  }

  /// Whether a run has begun that no call of settle() has completed.
  bool run_pending() const { return run_active_; }

  /// The medium at the settled front.
  MediumId value() const { return value_; }

  /// Leaves revealed so late that they changed the root behind the front. Never, for a correct structure.
  std::uint64_t seam_faults() const { return seam_faults_; }

 private:
  struct Event {
    double t;
    double bound;
    LeafId leaf;
    std::uint32_t face;
    std::uint32_t ordinal;
    bool entering;
    bool surface;
  };

  // The one order of crossings, as std::push_heap wants it: the heap's front is the earliest.
  static bool later(const Event& a, const Event& b) {
    if (a.t != b.t) return a.t > b.t;
    if (a.leaf != b.leaf) return a.leaf > b.leaf;
    return a.ordinal > b.ordinal;
  }

  Event pop() {
    std::pop_heap(queue_.begin(), queue_.end(), later);
    const Event e = queue_.back();
    queue_.pop_back();
    return e;
  }

  void flip(LeafId leaf) {
    if (state_.inside(leaf)) {
      const std::uint32_t place = inside_place_[leaf.get()];
      inside_[place] = inside_.back();
      inside_place_[inside_[place].get()] = place;
      inside_.pop_back();
    } else {
      inside_place_[leaf.get()] = static_cast<std::uint32_t>(inside_.size());
      inside_.push_back(leaf);
    }
    state_.flip(leaf);
    value_ = evaluate();
  }

  MediumId evaluate() const {
    if constexpr (MediumEvaluation<State>) {
      return state_.medium();
    } else {
      if (!state_.value()) return medium_outside;
      if (!source_.has_media()) return medium_opaque;
      const LeafId owner = find_owner();
      return owner ? source_.medium(owner) : medium_opaque;
    }
  }

  LeafId find_owner() const {
    if constexpr (MediumEvaluation<State>) {
      return state_.owner();
    } else {
      LeafId best;
      for (const LeafId leaf : inside_) {
        if (!state_.owns(leaf)) continue;
        if (best) {
          const double a = source_.priority(leaf), b = source_.priority(best);
          if (a < b || (a == b && leaf > best)) continue;
        }
        best = leaf;
      }
      return best;
    }
  }

  // The value the root would have with the leaf's bit flipped.
  MediumId value_if_flipped(LeafId leaf) {
    flip(leaf);
    const MediumId value = value_;
    flip(leaf);
    return value;
  }

  bool shows_surface(LeafId leaf) { return value_if_flipped(leaf) != value_; }

  void begin_run(const Event& first, MediumId before) {
    run_active_ = true;
    run_shows_surface_ = first.surface;
    run_first_ = first;
    run_before_ = before;
    run_high_ = first.t + first.bound;
    // Of the crossings before it, those whose interval ends before the run's begins can meet no later run either.
    const double low = first.t - first.bound;
    std::erase_if(trail_, [low](const Event& e) { return e.t + e.bound < low; });
    run_begin_ = trail_.size() - 1;  // `first` was the last to be processed
    end_run_here();
  }

  // The crossing just processed changed the root, and is the run's last so far.
  void end_run_here() {
    run_after_ = value_;
    run_end_ = trail_.size();
  }

  // No crossing at the limit or behind it can belong to the run: not one of a leaf still to be revealed, for its whole
  // interval lies behind the limit, and not one in the queue.
  bool run_ends_before(double limit) const {
    if (limit == std::numeric_limits<double>::infinity()) return true;
    if (!(run_high_ < limit)) return false;
    return std::none_of(queue_.begin(), queue_.end(), [this](const Event& e) { return meets_run(e); });
  }

  bool meets_run(const Event& e) const {
    return e.t - e.bound <= run_high_ && e.t + e.bound >= run_first_.t - run_first_.bound;
  }

  // The run is complete; what it amounts to, or nothing. It is judged in the states before and behind all that
  // coincides: what else the ray has crossed by now depends on the structure.
  std::optional<Run> close_run() {
    run_active_ = false;
    if (run_before_ == run_after_ && !run_shows_surface_) return std::nullopt;

    candidates_.clear();
    for (const Event& e : trail_) {
      if (meets_run(e)) candidates_.push_back(e);
    }
    for (const Event& e : queue_) {
      if (meets_run(e)) candidates_.push_back(e);
    }
    const bool coincide = candidates_.size() > 1;
    if (coincide) {
      std::sort(candidates_.begin(), candidates_.end(),
                [](const Event& a, const Event& b) { return a.leaf != b.leaf ? a.leaf < b.leaf : later(b, a); });
    }
    alone_.assign(candidates_.size(), !coincide);

    const std::size_t now = trail_.size();
    rewind(now, run_end_);
    pass_coinciding({trail_.data() + run_end_, now - run_end_}, queue_, run_after_);
    if (coincide) mark_candidates_that_change_root();
    LeafId owner;
    if (run_after_ != medium_outside) owner = find_owner();
    take_back_passed();
    if (coincide || run_after_ == medium_outside) {
      rewind(run_end_, run_begin_);
      pass_coinciding({trail_.data(), run_begin_}, {}, run_before_);
      if (coincide) mark_candidates_that_change_root();
      if (run_after_ == medium_outside) owner = find_owner();
      take_back_passed();
      replay(run_begin_, run_end_);
    }
    replay(run_end_, now);

    Run run;
    const Event shown = take_faces(run);
    run.t = run_first_.t;
    run.bound = run_first_.bound;
    run.surface = {shown.leaf, shown.face};
    run.leaf_entering = shown.entering;
    run.is_surface = shown.surface;
    run.owner = owner;
    run.before = run_before_;
    run.after = run_after_;
    return run;
  }

  // Takes the state to the far end of what coincides with the run: crossings that do not change the root there have
  // rounding's order too, but say whose point it is. So of two solids that touch in a plane where both are cut, the one
  // that is left owns the cut. Crossings that do change it, since the run ended before them, are not the run's.
  void pass_coinciding(std::span<const Event> some, std::span<const Event> others, MediumId value) {
    if (candidates_.size() < 2) return;
    for (const std::span<const Event> events : {some, others}) {
      for (const Event& e : events) {
        if (!e.surface && meets_run(e)) passed_.push_back(e.leaf);
      }
    }
    for (const LeafId leaf : passed_) flip(leaf);
    if (value_ != value) take_back_passed();
  }
  void take_back_passed() {
    for (const LeafId leaf : passed_) flip(leaf);
    passed_.clear();
  }

  void mark_candidates_that_change_root() {
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      if (value_if_flipped(candidates_[i].leaf) != value_) alone_[i] = true;
    }
  }

  // The faces of the run are those that matter beside it, one for each leaf. Others may lie there too, such as what is
  // subtracted outside of what it is subtracted from; some structures never see them, and nobody may depend on them.
  // Of a leaf that the ray only grazes a structure may have missed the crossings before its enclosure, never the last.
  // @return the one that shows: the first in tree order
  Event take_faces(Run& run) const {
    const Event* shown = nullptr;
    for (std::size_t i = 0; i < candidates_.size(); ++i) {
      const Event* face = &candidates_[i];
      for (; i + 1 < candidates_.size() && candidates_[i + 1].leaf == face->leaf; ++i) {
        if (face->ordinal != run_first_.ordinal || face->leaf != run_first_.leaf) face = &candidates_[i + 1];
      }
      if (!alone_[i]) continue;
      if (shown == nullptr) shown = face;
      run.faces.push_back({face->leaf, face->face});
    }
    if (shown != nullptr) return *shown;
    // Nothing changes the root alone where two faces must come together.
    run.faces.push_back({run_first_.leaf, run_first_.face});
    return run_first_;
  }

  // Takes the state back along the trail, and forth again.
  void rewind(std::size_t from, std::size_t to) {
    for (std::size_t i = from; i-- > to;) {
      if (!trail_[i].surface) flip(trail_[i].leaf);
    }
  }
  void replay(std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      if (!trail_[i].surface) flip(trail_[i].leaf);
    }
  }

  State state_;
  Source source_;
  std::vector<std::uint32_t> revealed_;  // the stamp of the ray that revealed the leaf
  std::uint32_t stamp_ = 0;

  std::vector<Event> queue_;                 // crossings ahead, a heap
  std::vector<Event> trail_;                 // crossings processed that may still meet a run
  std::vector<LeafId> inside_;               // the leaves that hold the point at the front
  std::vector<std::uint32_t> inside_place_;  // where in inside_ a leaf stands that is there
  double begin_ = 0;                         // where the ray starts
  double front_ = 0;
  MediumId value_ = medium_outside;
  bool started_ = false;    // settle() was called for this ray
  bool absorbing_ = false;  // no change of the root has come that the start does not absorb

  bool run_active_ = false;
  bool run_shows_surface_ = false;
  Event run_first_{};
  MediumId run_before_ = medium_outside;
  MediumId run_after_ = medium_outside;
  double run_high_ = 0;
  std::size_t run_begin_ = 0;  // into trail_: the run's first crossing
  std::size_t run_end_ = 0;    // and the place behind its last that changed the root

  std::uint64_t seam_faults_ = 0;
  Spans spans_;
  std::vector<Event> candidates_;
  std::vector<LeafId> passed_;
  std::vector<bool> alone_;
};

}  // namespace tenon
