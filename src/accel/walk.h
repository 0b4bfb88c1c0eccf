#pragma once

#include "csg/csg_tree.h"
#include "csg/expression.h"
#include "csg/tree_source.h"
#include "tenon/accel/accelerator.h"

namespace tenon {

/// One ray's way through a structure. The structure reveals leaves and settles; what becomes of the boundaries found is
/// not its business.
class Walk {
 public:
  using Sink = FunctionRef<bool(const Run&)>;  ///< returns true when the ray has what it wants

  Walk(TreeClassifier& classifier, const RayQuery& query, TraversalCounters& counters, Sink sink)
      : classifier_(classifier), query_(query), counters_(counters), sink_(sink) {}

  const RayQuery& query() const { return query_; }
  const Ray& ray() const { return query_.ray; }
  TraversalCounters& counters() { return counters_; }

  /// A leaf that stands in several cells is intersected in each of them, as by a paper that has no mailboxes. Only the
  /// cost differs, never the answer.
  void use_mailbox(bool on) { mailbox_ = on; }

  /// Intersects a leaf with the ray, unless its mailbox knows the answer.
  void reveal(LeafId leaf) {
    if (classifier_.reveal(leaf)) {
      ++counters_.primitive_tests;
    } else if (mailbox_) {
      ++counters_.mailbox_hits;
    } else {
      classifier_.intersect_again(leaf);
      ++counters_.primitive_tests;
    }
  }

  /// Every leaf that can change the root before `t` has been revealed.
  /// @return true when the ray is done and the structure must stop
  bool settle(double t) {
    if (done_) return true;
    // The start belongs to no stretch of the ray: a leaf whose box holds the origin may still come.
    if (!(t > 0)) return false;
    while (const std::optional<Run> run = classifier_.settle(t)) {
      if (!(run->t < query_.t_max)) {
        end_value_ = run->before;
        return done_ = ended_ = true;
      }
      if (sink_(*run)) return done_ = true;
    }
    return done_ = t >= query_.t_max && !classifier_.run_pending();
  }

  /// The medium at the end of the ray, t_max, once the ray is done without the sink having stopped it.
  MediumId final_value() const { return ended_ ? end_value_ : classifier_.value(); }

  /// No leaf ahead has been left out: settles the rest of the ray.
  void finish() { settle(std::numeric_limits<double>::infinity()); }

 private:
  TreeClassifier& classifier_;
  const RayQuery& query_;
  TraversalCounters& counters_;
  Sink sink_;
  bool mailbox_ = true;
  bool done_ = false;
  bool ended_ = false;                   // a boundary behind t_max was met
  MediumId end_value_ = medium_outside;  // and this is the medium before it
};

}  // namespace tenon
