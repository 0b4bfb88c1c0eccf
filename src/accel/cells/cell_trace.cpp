#include "accel/cells/cell_trace.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "primitive/dispatch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "accel/cells/cell_trace.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#include "accel/cells/chord-inl.h"

HWY_BEFORE_NAMESPACE();
namespace tenon::cells {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using One = hn::CappedTag<double, 1>;

// A ray in single precision, relative to the tree's center and started where it meets the scene.
struct BoxRay8 {
  float origin[3];
  float inverse[3];
  int backward[3];  // 1 where the direction is negative
  float t_end;
};

struct Visit {
  std::uint32_t child;
  float t_in, t_out;
};

HWY_INLINE float Inverse(double direction) {
  constexpr double most = 0x1p100;
  const double inverse = 1 / direction;
  // An axis that the ray does not move along: whatever the sign, planes are far.
  return static_cast<float>(std::clamp(inverse, -most, most));
}

// One ray at a time.
class SingleTracer {
 public:
  SingleTracer(const CellTree& cells, const CsgTree& tree, CellScratch& scratch, bool faces_wanted)
      : cells_(cells), tree_(tree), scratch_(scratch), faces_wanted_(faces_wanted) {}

  CellAnswer Trace(const RayQuery& query, TraversalCounters& counters) {
    query_ = &query;
    CellAnswer answer;
    const Vec3 &o = query.ray.origin, &d = query.ray.direction;
    const double square = dot(d, d);
    // False for what is not a number, too.
    const bool sound = max_component(abs(o)) <= cells_.scale.far_origin && square >= 0x1p-200 && square <= 0x1p200;
    if (!sound) {
      answer.kind = CellAnswer::Kind::unsure;
      return answer;
    }
    if (!Begin(o, d, square)) return answer;
    ++scratch_.ray;
    return Walk(counters);
  }

 private:
  bool Begin(const Vec3& o, const Vec3& d, double square) {
    // Where the line is in the scene's box.
    double near = 0, far = query_->t_max;
    for (int axis = 0; axis < 3; ++axis) {
      const double inverse = 1 / d[axis];
      const double a = (cells_.box.lower[axis] - o[axis]) * inverse, b = (cells_.box.upper[axis] - o[axis]) * inverse;
      // Comparisons with NaN, in a plane of the box, are false and leave the ends alone.
      const double first = a < b ? a : b, last = a < b ? b : a;
      if (first > near) near = first;
      if (last < far) far = last;
    }
    if (!(near <= far)) return false;
    start_ = near;
    const double length = far - near;
    // Rounded up; the slack of the boxes covers half an ulp, not what lies behind t_max.
    box_ray_.t_end = static_cast<float>(length * (1 + 0x1p-20));
    const Vec3 from = o + near * d - cells_.center;
    for (int axis = 0; axis < 3; ++axis) {
      box_ray_.origin[axis] = static_cast<float>(from[axis]);
      box_ray_.inverse[axis] = Inverse(d[axis]);
      box_ray_.backward[axis] = box_ray_.inverse[axis] < 0;
    }
    const double inverse_square = 1 / square;
    length_ = std::sqrt(square);
    resolution_ = cells_.scale.resolution / length_;
    together_ = tree_.tolerance.distance / length_;
    const One one;
    ray_.origin = {hn::Set(one, o.x), hn::Set(one, o.y), hn::Set(one, o.z)};
    ray_.direction = {hn::Set(one, d.x), hn::Set(one, d.y), hn::Set(one, d.z)};
    ray_.square = hn::Set(one, square);
    ray_.inverse = hn::Set(one, inverse_square);
    ray_.resolution = hn::Set(one, resolution_);
    return true;
  }

  // Pushes the children that the ray meets, the nearest last.
  HWY_INLINE void Open(const WideNode& node, float t_end, Visit*& top) {
    const hn::CappedTag<float, node_width> wide;
    HWY_ALIGN float t_in[node_width];
    HWY_ALIGN float t_out[node_width];
    std::uint32_t met = 0;
    for (std::size_t lane = 0; lane < node_width; lane += hn::Lanes(wide)) {
      auto near = hn::Zero(wide), far = hn::Set(wide, t_end);
      for (int axis = 0; axis < 3; ++axis) {
        const auto origin = hn::Set(wide, box_ray_.origin[axis]);
        const auto inverse = hn::Set(wide, box_ray_.inverse[axis]);
        const auto& ends = node.ends[static_cast<std::size_t>(axis)];
        const auto first = static_cast<std::size_t>(box_ray_.backward[axis]);
        near = hn::Max(near, hn::Mul(hn::Sub(hn::Load(wide, ends[first].data() + lane), origin), inverse));
        far = hn::Min(far, hn::Mul(hn::Sub(hn::Load(wide, ends[1 - first].data() + lane), origin), inverse));
      }
      hn::Store(near, wide, t_in + lane);
      hn::Store(far, wide, t_out + lane);
      std::uint8_t bits[8] = {};
      hn::StoreMaskBits(wide, hn::Le(near, far), bits);
      met |= static_cast<std::uint32_t>(bits[0]) << lane;
    }
    Visit* const first = top;
    for (; met != 0; met &= met - 1) {
      const auto lane = static_cast<std::size_t>(std::countr_zero(met));
      const Visit visit{node.children[lane].bits, t_in[lane], t_out[lane]};
      Visit* place = top++;
      for (; place != first && place[-1].t_in < visit.t_in; --place) *place = place[-1];
      *place = visit;
    }
  }

  CellAnswer Walk(TraversalCounters& counters) {
    // A node is replaced by at most eight children.
    Visit stack[most_depth * (node_width - 1) + 1];
    Visit* top = stack;
    CellAnswer answer;
    Open(cells_.nodes.front(), box_ray_.t_end, top);
    std::uint64_t visited = 0;
    tests_ = 0;
    while (top != stack) {
      const Visit visit = *--top;
      const ChildRef child{visit.child};
      if (!child.is_cell()) {
        Open(cells_.nodes[child.index()], box_ray_.t_end, top);
        continue;
      }
      ++visited;
      const Cell& cell = cells_.cells[child.index()];
      const double t_in = visit.t_in + start_, t_out = visit.t_out + start_;
      Outcome outcome = Meet(cell, t_in, t_out, answer);
      if (outcome == Outcome::unsure) outcome = Resolve(cell, t_in, t_out, answer);
      if (outcome == Outcome::passed) continue;
      if (outcome == Outcome::unsure) {
        answer.kind = CellAnswer::Kind::unsure;
      } else if (answer.t < query_->t_max) {
        answer.kind = CellAnswer::Kind::boundary;
        answer.cell = child.index();
      } else {
        answer.kind = CellAnswer::Kind::nothing;
      }
      break;
    }
    counters.cells_visited += visited;
    counters.primitive_tests += tests_;
    return answer;
  }

  enum class Outcome { passed, met, unsure };

  HWY_INLINE ChordLanes<One> FindChord(ShapeRef shape, int on_face) {
    const One one;
    const PlacedShapes& s = cells_.shapes;
    const double reach = cells_.scale.reach;
    const auto length = hn::Set(one, length_);
    switch (shape.kind()) {
      case ShapeKind::upright_sphere:
        return SphereChord(one, ray_, s.upright_spheres[shape.index()], on_face);
      case ShapeKind::sphere:
        return SphereChord(one, ray_, s.spheres[shape.index()], on_face);
      case ShapeKind::upright_box:
        return BoxChord(one, ray_, s.upright_boxes[shape.index()], on_face, reach, length);
      case ShapeKind::box:
        return BoxChord(one, ray_, s.boxes[shape.index()], on_face, reach, length);
      case ShapeKind::cylinder:
        return CylinderChord(one, ray_, s.cylinders[shape.index()], on_face, reach, length);
      case ShapeKind::general:
        break;
    }
    return WholeLine(one);
  }

  const Spans& FindSpans(LeafId leaf, int on_face) {
    auto& known = scratch_.mailbox[leaf.get() % CellScratch::known];
    if (known.ray == scratch_.ray && known.leaf == leaf) return known.spans;
    ++tests_;
    known.ray = scratch_.ray;
    known.leaf = leaf;
    known.spans.clear();
    const Leaf& placed = tree_[leaf];
    spans(tree_.primitives, placed.primitive, placed.placement, query_->ray, tree_.tolerance.distance, on_face,
          known.spans);
    return known.spans;
  }

  HWY_INLINE Outcome Meet(const Cell& cell, double t_in, double t_out, CellAnswer& answer) {
    // Leaves that do not all have a chord, or more than a word of truth values has room for.
    if (cell.extended || cell.general) return Outcome::unsure;
    const double near = 2 * resolution_;
    // A leaf that the ray misses is crossed nowhere.
    constexpr double never = std::numeric_limits<double>::infinity();
    double enter[Cell::most_tabled], leave[Cell::most_tabled], next[Cell::most_tabled];
    double enter_face[Cell::most_tabled], leave_face[Cell::most_tabled];
    const One one;
    std::uint32_t state = 0;
    const std::uint32_t count = cell.leaf_count;
    tests_ += count;
    const bool starts = t_in <= near;
    for (std::uint32_t i = 0; i < count; ++i) {
      const int on_face = start_face(*query_, cell.leaves[i]);
      const ChordLanes<One> chord = FindChord(cell.shapes[i], on_face);
      if (!hn::AllFalse(one, chord.unsure)) return Outcome::unsure;
      const bool hit = !hn::AllFalse(one, chord.hit);
      enter[i] = hit ? hn::GetLane(chord.enter) : never;
      leave[i] = hit ? hn::GetLane(chord.leave) : never;
      enter_face[i] = hn::GetLane(chord.enter_face);
      leave_face[i] = hn::GetLane(chord.leave_face);
      if (starts && !StartIsClear(enter[i], leave[i], on_face, near)) return Outcome::unsure;
      const bool inside = enter[i] <= t_in && t_in < leave[i];
      state |= static_cast<std::uint32_t>(inside) << i;
      next[i] = inside ? leave[i] : enter[i] > t_in ? enter[i] : never;
    }
    const std::uint64_t table = cell.table;
    const std::uint64_t before = table >> state & 1;
    for (;;) {
      std::uint32_t first = 0;
      double t = next[0];
      for (std::uint32_t i = 1; i < count; ++i) {
        if (next[i] < t) {
          t = next[i];
          first = i;
        }
      }
      if (!(t <= t_out)) return Outcome::passed;
      // Crossings at the same double are one step: a change that is undone there is none.
      for (std::uint32_t i = 0; i < count; ++i) {
        if (next[i] != t) continue;
        state ^= 1U << i;
        next[i] = (state >> i & 1) != 0 ? leave[i] : never;
      }
      if ((table >> state & 1) == before) continue;
      Group group;
      if (!FindGroup(count, enter, leave, t, group)) return Outcome::unsure;
      if (group.size > 1) {
        if (faces_wanted_) return Outcome::unsure;
        const std::uint32_t after = group.After(state);
        if ((table >> after & 1) == before) {
          // The faces that coincide cancel.
          for (std::uint32_t k = 0; k < group.size; ++k) {
            const std::uint32_t i = group.ends[k].place;
            next[i] = group.ends[k].entering ? leave[i] : never;
          }
          state = after;
          continue;
        }
        const Group::End shown = group.Shown(table, after);
        answer.t = group.FirstChange(table, after).t;
        answer.leaf_entering = shown.entering;
        answer.before = before != 0;
        answer.surface = {
            cell.leaves[shown.place],
            static_cast<std::uint32_t>(shown.entering ? enter_face[shown.place] : leave_face[shown.place])};
        return Outcome::met;
      }
      answer.t = t;
      answer.leaf_entering = (state >> first & 1) != 0;
      answer.before = before != 0;
      answer.surface = {cell.leaves[first],
                        static_cast<std::uint32_t>(answer.leaf_entering ? enter_face[first] : leave_face[first])};
      return Outcome::met;
    }
  }

  // Crossings that certainly form one run: their bounds are at least the scene's tolerance, they are no further apart.
  struct Group {
    struct End {
      double t = 0;
      std::uint32_t place = 0;
      bool entering = false;
    };
    End ends[Cell::most_tabled];
    std::uint32_t size = 0;

    // Keeps the order of the classifier.
    void Add(const End& end) {
      std::uint32_t place = size++;
      for (; place > 0; --place) {
        const End& other = ends[place - 1];
        if (other.t < end.t || (other.t == end.t && other.place < end.place)) break;
        ends[place] = other;
      }
      ends[place] = end;
    }

    // The state behind them all, from one in which some of them have been crossed.
    std::uint32_t After(std::uint32_t state) const {
      for (std::uint32_t k = 0; k < size; ++k) {
        const std::uint32_t bit = 1U << ends[k].place;
        state = ends[k].entering ? state | bit : state & ~bit;
      }
      return state;
    }

    std::uint32_t Before(std::uint32_t after) const {
      for (std::uint32_t k = 0; k < size; ++k) after ^= 1U << ends[k].place;
      return after;
    }

    const End& FirstChange(std::uint64_t table, std::uint32_t after) const {
      std::uint32_t state = Before(after);
      const std::uint64_t value = table >> state & 1;
      for (std::uint32_t k = 0; k < size; ++k) {
        state ^= 1U << ends[k].place;
        if ((table >> state & 1) != value) return ends[k];
      }
      return ends[0];
    }

    // The first leaf whose bit alone changes the value right before the run or right after it (Classifier).
    const End& Shown(std::uint64_t table, std::uint32_t after) const {
      std::uint32_t state = Before(after), begin = state, end = state;
      bool changed = false;
      for (std::uint32_t k = 0; k < size; ++k) {
        const std::uint32_t crossed = state ^ 1U << ends[k].place;
        if ((table >> crossed & 1) != (table >> state & 1)) {
          if (!changed) begin = state;
          changed = true;
          end = crossed;
        }
        state = crossed;
      }
      const End* shown = nullptr;
      for (std::uint32_t k = 0; k < size; ++k) {
        const std::uint32_t bit = 1U << ends[k].place;
        const bool alone =
            (table >> (begin ^ bit) & 1) != (table >> begin & 1) || (table >> (end ^ bit) & 1) != (table >> end & 1);
        if (alone && (shown == nullptr || ends[k].place < shown->place)) shown = &ends[k];
      }
      return shown != nullptr ? *shown : FirstChange(table, after);
    }
  };

  // Collects the crossings at t; false when some may or may not belong to them.
  bool FindGroup(std::uint32_t count, const double* enter, const double* leave, double t, Group& group) const {
    const double near = 2 * resolution_;
    const auto collect = [&](double end, std::uint32_t place, bool entering) {
      const double apart = std::fabs(end - t);
      if (!(apart <= near)) return true;
      if (!(apart <= together_) || group.size == Cell::most_tabled) return false;
      group.Add({end, place, entering});
      return true;
    };
    for (std::uint32_t i = 0; i < count; ++i) {
      // A chord is longer than four resolutions, so one of its ends at most is near.
      if (!collect(enter[i], i, true) || !collect(leave[i], i, false)) return false;
    }
    return true;
  }

  // The start: of a leaf nothing but the face that the ray starts on may lie there.
  static bool StartIsClear(double enter, double leave, int on_face, double near) {
    const bool enters_here = std::fabs(enter) <= near, leaves_here = std::fabs(leave) <= near;
    if (on_face < 0) return !enters_here && !leaves_here;
    return enters_here != leaves_here && (enters_here ? enter : leave) == 0;
  }

  // Has the classifier follow the ray through the cell, with the bounds of all crossings.
  //
  // The cell's expression is right within 8 resolutions around the stretch (CellScale). A run that begins in it takes
  // crossings at most two away, so none that lies further off has a part in it, as long as the bounds are no larger
  // than the resolution.
  HWY_NOINLINE Outcome Resolve(const Cell& cell, double t_in, double t_out, CellAnswer& answer) {
    if (cell.extended && cells_.extended[cell.table].leaf_count > Cell::most_followed) return Outcome::unsure;
    if (!scratch_.classifier) scratch_.classifier.emplace(CellState{}, CellCrossings{}, cells_.most_leaves);
    CellClassifier& classifier = *scratch_.classifier;
    const std::span<const LeafId> leaves = cells_.leaves_of(cell);
    auto& lists = classifier.source().of_leaf;
    if (lists.size() < leaves.size()) lists.resize(leaves.size());
    const double near = 8 * resolution_;
    for (std::size_t i = 0; i < leaves.size(); ++i) {
      const Spans& known = FindSpans(leaves[i], start_face(*query_, leaves[i]));
      for (const Crossing& c : known) {
        const bool matters = c.t + c.bound >= t_in - near && c.t - c.bound <= t_out + near;
        if (c.surface || (matters && !(c.bound <= resolution_))) return Outcome::unsure;
      }
      lists[i] = known;
    }
    classifier.state().enter(cell, cells_.symbols_of(cell));
    classifier.start();
    for (std::size_t i = 0; i < leaves.size(); ++i) classifier.reveal(LeafId{i});
    while (std::optional<Run> run = classifier.settle(std::numeric_limits<double>::infinity())) {
      if (run->t > t_out) break;
      if (!(run->t > t_in)) continue;
      answer.t = run->t;
      answer.leaf_entering = run->leaf_entering;
      answer.before = run->before != medium_outside;
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

  static constexpr std::size_t most_depth = 64;

  const CellTree& cells_;
  const CsgTree& tree_;
  CellScratch& scratch_;
  const RayQuery* query_ = nullptr;
  double start_ = 0;
  double length_ = 1;
  double resolution_ = 0;
  double together_ = 0;
  bool faces_wanted_;
  BoxRay8 box_ray_{};
  RayLanes<One> ray_{};
  std::uint64_t tests_ = 0;
};

// Doubles in a vector, at most eight.
constexpr std::size_t MaxLanes8() {
  return hn::MaxLanes(hn::CappedTag<double, 8>());
}

// As many rays as there are lanes, all into the same octant and none from a surface.
class PacketTracer {
 public:
  using D = hn::CappedTag<double, 8>;
  using F = hn::CappedTag<float, MaxLanes8()>;
  using U = hn::RebindToUnsigned<D>;
  static constexpr std::size_t width = MaxLanes8();

  explicit PacketTracer(const CellTree& cells) : cells_(cells) {}

  // Answers `width` rays; false when they do not make a packet.
  bool Trace(const RayQuery* queries, CellAnswer* answers, TraversalStatistics& statistics) {
    if (!Begin(queries)) return false;
    for (std::size_t lane = 0; lane < width; ++lane) answers[lane] = CellAnswer{};
    Walk();
    for (std::size_t lane = 0; lane < width; ++lane) {
      CellAnswer& answer = answers[lane];
      if ((unsure_ >> lane & 1) != 0) {
        answer.kind = CellAnswer::Kind::unsure;
      } else if (found_[lane] != none && best_t_[lane] < queries[lane].t_max) {
        answer.kind = CellAnswer::Kind::boundary;
        answer.t = best_t_[lane];
        answer.cell = found_[lane];
        const Cell& cell = cells_.cells[answer.cell];
        const auto place = static_cast<std::size_t>(place_[lane]);
        answer.surface = {cell.leaves[place], static_cast<std::uint32_t>(face_[lane])};
        answer.leaf_entering = entering_[lane] != 0;
        answer.before = before_[lane] != 0;
      }
    }
    TraversalCounters& counters = statistics[queries[0].kind];
    counters.cells_visited += visited_;
    counters.primitive_tests += tests_;
    return true;
  }

 private:
  static constexpr std::uint32_t none = ~std::uint32_t{0};

  struct Entry {
    HWY_ALIGN float near[width];
    HWY_ALIGN float far[width];
    float key;
    std::uint32_t child;
  };

  bool Begin(const RayQuery* queries) {
    HWY_ALIGN double o[3][width];
    HWY_ALIGN double v[3][width];
    HWY_ALIGN double ends[width];
    for (std::size_t lane = 0; lane < width; ++lane) {
      const RayQuery& query = queries[lane];
      if (query.from != nullptr || query.kind != queries[0].kind) return false;
      for (int axis = 0; axis < 3; ++axis) {
        o[axis][lane] = query.ray.origin[axis];
        v[axis][lane] = query.ray.direction[axis];
      }
      ends[lane] = query.t_max;
    }
    const D d;
    ray_.origin = {hn::Load(d, o[0]), hn::Load(d, o[1]), hn::Load(d, o[2])};
    ray_.direction = {hn::Load(d, v[0]), hn::Load(d, v[1]), hn::Load(d, v[2])};
    ray_.square = Dot(ray_.direction, ray_.direction);
    const auto farthest = hn::Max(hn::Max(hn::Abs(ray_.origin.x), hn::Abs(ray_.origin.y)), hn::Abs(ray_.origin.z));
    const auto sound =
        hn::And(hn::Le(farthest, hn::Set(d, cells_.scale.far_origin)),
                hn::And(hn::Ge(ray_.square, hn::Set(d, 0x1p-200)), hn::Le(ray_.square, hn::Set(d, 0x1p200))));
    if (!hn::AllTrue(d, sound)) return false;

    const auto zero = hn::Zero(d);
    auto near = zero, far = hn::Load(d, ends);
    const hn::Vec<D> origins[3] = {ray_.origin.x, ray_.origin.y, ray_.origin.z};
    const hn::Vec<D> directions[3] = {ray_.direction.x, ray_.direction.y, ray_.direction.z};
    const F f;
    for (int axis = 0; axis < 3; ++axis) {
      const auto backward = hn::Lt(directions[axis], zero);
      // A direction of zero has no side of its own; it is left to single rays.
      if (!hn::AllTrue(d, backward) && !hn::AllTrue(d, hn::Gt(directions[axis], zero))) return false;
      backward_[axis] = hn::AllTrue(d, backward) ? 1 : 0;
      const auto most = hn::Set(d, 0x1p100);
      auto inverse = hn::Div(hn::Set(d, 1.0), directions[axis]);
      inverse = hn::Max(hn::Min(inverse, most), hn::Neg(most));
      const double low = cells_.box.lower[axis], high = cells_.box.upper[axis];
      const auto first = hn::Set(d, backward_[axis] != 0 ? high : low),
                 last = hn::Set(d, backward_[axis] != 0 ? low : high);
      near = hn::Max(near, hn::Mul(hn::Sub(first, origins[axis]), inverse));
      far = hn::Min(far, hn::Mul(hn::Sub(last, origins[axis]), inverse));
      hn::Store(hn::DemoteTo(f, inverse), f, inverse_[axis]);
    }
    const auto inside = hn::Le(near, far);
    start_ = hn::IfThenElse(inside, near, zero);
    for (int axis = 0; axis < 3; ++axis) {
      const auto from =
          hn::Sub(hn::Add(origins[axis], hn::Mul(start_, directions[axis])), hn::Set(d, cells_.center[axis]));
      hn::Store(hn::DemoteTo(f, from), f, origin_[axis]);
    }
    // Below zero for rays that do not meet the scene.
    const auto length = hn::IfThenElse(inside, hn::Mul(hn::Sub(far, near), hn::Set(d, 1 + 0x1p-20)), hn::Set(d, -1.0));
    hn::Store(hn::DemoteTo(f, hn::Min(length, hn::Set(d, 0x1p100))), f, end_);
    length_ = hn::Sqrt(ray_.square);
    ray_.inverse = hn::Div(hn::Set(d, 1.0), ray_.square);
    ray_.resolution = hn::Div(hn::Set(d, cells_.scale.resolution), length_);
    unsure_ = 0;
    visited_ = tests_ = 0;
    hn::Store(hn::Set(d, std::numeric_limits<double>::infinity()), d, best_t_);
    for (std::uint32_t& cell : found_) cell = none;
    return true;
  }

  static std::uint32_t Bits(hn::Mask<D> mask) {
    const D d;
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(d, mask, bits);
    return bits[0];
  }

  HWY_INLINE void Open(const WideNode& node, Entry*& top) {
    const F f;
    hn::Vec<F> origin[3], inverse[3];
    for (int axis = 0; axis < 3; ++axis) {
      origin[axis] = hn::Load(f, origin_[axis]);
      inverse[axis] = hn::Load(f, inverse_[axis]);
    }
    const auto end = hn::Load(f, end_);
    Entry* const first = top;
    for (std::size_t child = 0; child < node_width; ++child) {
      if (node.children[child].bits == ChildRef{}.bits) break;
      auto near = hn::Zero(f), far = end;
      for (int axis = 0; axis < 3; ++axis) {
        const auto& ends = node.ends[static_cast<std::size_t>(axis)];
        const auto side = static_cast<std::size_t>(backward_[axis]);
        near = hn::Max(near, hn::Mul(hn::Sub(hn::Set(f, ends[side][child]), origin[axis]), inverse[axis]));
        far = hn::Min(far, hn::Mul(hn::Sub(hn::Set(f, ends[1 - side][child]), origin[axis]), inverse[axis]));
      }
      const auto met = hn::Le(near, far);
      if (hn::AllFalse(f, met)) continue;
      // Boxes do not overlap, so any lane tells the order for all.
      Entry entry;
      hn::Store(near, f, entry.near);
      hn::Store(hn::IfThenElse(met, far, hn::Set(f, -1.0F)), f, entry.far);
      entry.key = entry.near[hn::FindFirstTrue(f, met)];
      entry.child = node.children[child].bits;
      Entry* place = top++;
      for (; place != first && place[-1].key < entry.key; --place) *place = place[-1];
      *place = entry;
    }
  }

  void Walk() {
    Entry* const stack = stack_.data();
    Entry* top = stack;
    const F f;
    Open(cells_.nodes.front(), top);
    while (top != stack) {
      const Entry& entry = *--top;
      const ChildRef child{entry.child};
      const auto near = hn::Load(f, entry.near);
      const auto far = hn::Min(hn::Load(f, entry.far), hn::Load(f, end_));
      const auto active = hn::Le(near, far);
      if (hn::AllFalse(f, active)) continue;
      if (!child.is_cell()) {
        Open(cells_.nodes[child.index()], top);
        continue;
      }
      const D d;
      const auto t_in = hn::Add(hn::PromoteTo(d, near), start_);
      const auto t_out = hn::Add(hn::PromoteTo(d, far), start_);
      const auto lanes = hn::Le(hn::PromoteTo(d, near), hn::PromoteTo(d, far));
      visited_ += static_cast<std::uint64_t>(std::popcount(Bits(lanes)));
      Meet(child.index(), lanes, t_in, t_out);
    }
  }

  HWY_INLINE ChordLanes<D> FindChord(ShapeRef shape) {
    const D d;
    const PlacedShapes& s = cells_.shapes;
    const double reach = cells_.scale.reach;
    switch (shape.kind()) {
      case ShapeKind::upright_sphere:
        return SphereChord(d, ray_, s.upright_spheres[shape.index()], -1);
      case ShapeKind::sphere:
        return SphereChord(d, ray_, s.spheres[shape.index()], -1);
      case ShapeKind::upright_box:
        return BoxChord(d, ray_, s.upright_boxes[shape.index()], -1, reach, length_);
      case ShapeKind::box:
        return BoxChord(d, ray_, s.boxes[shape.index()], -1, reach, length_);
      case ShapeKind::cylinder:
        return CylinderChord(d, ray_, s.cylinders[shape.index()], -1, reach, length_);
      case ShapeKind::general:
        break;
    }
    return WholeLine(d);
  }

  void DropLanes(std::uint32_t lanes) {
    unsure_ |= lanes;
    for (std::size_t lane = 0; lane < width; ++lane) {
      if ((lanes >> lane & 1) != 0) end_[lane] = -1;
    }
  }

  // SingleTracer::Meet for all lanes at once; what it resolves is left to it.
  void Meet(std::uint32_t index, hn::Mask<D> lanes, hn::Vec<D> t_in, hn::Vec<D> t_out) {
    const Cell& cell = cells_.cells[index];
    if (cell.general || cell.extended) {
      DropLanes(Bits(lanes));
      return;
    }
    const D d;
    const U u;
    const auto never = hn::Set(d, std::numeric_limits<double>::infinity());
    const auto near = hn::Add(ray_.resolution, ray_.resolution);
    const auto starts = hn::Le(t_in, near);
    const std::uint32_t count = cell.leaf_count;
    tests_ += count * static_cast<std::uint64_t>(std::popcount(Bits(lanes)));
    hn::Vec<D> enter[Cell::most_tabled], leave[Cell::most_tabled], next[Cell::most_tabled];
    hn::Vec<D> enter_face[Cell::most_tabled], leave_face[Cell::most_tabled];
    auto state = hn::Zero(u);
    auto unsure = hn::Lt(near, hn::Zero(d));
    for (std::uint32_t i = 0; i < count; ++i) {
      const ChordLanes<D> chord = FindChord(cell.shapes[i]);
      enter[i] = hn::IfThenElse(chord.hit, chord.enter, never);
      leave[i] = hn::IfThenElse(chord.hit, chord.leave, never);
      enter_face[i] = chord.enter_face;
      leave_face[i] = chord.leave_face;
      unsure = hn::Or(unsure, chord.unsure);
      const auto here = hn::Or(hn::Le(hn::Abs(enter[i]), near), hn::Le(hn::Abs(leave[i]), near));
      unsure = hn::Or(unsure, hn::And(starts, here));
      const auto inside = hn::And(hn::Le(enter[i], t_in), hn::Lt(t_in, leave[i]));
      state = hn::Or(state, hn::IfThenElseZero(hn::RebindMask(u, inside), hn::Set(u, std::uint64_t{1} << i)));
      const auto ahead = hn::IfThenElse(hn::Gt(enter[i], t_in), enter[i], never);
      next[i] = hn::IfThenElse(inside, leave[i], ahead);
    }
    const auto table = hn::Set(u, cell.table);
    const auto one = hn::Set(u, 1);
    const auto before = hn::And(hn::Shr(table, state), one);
    auto active = hn::AndNot(unsure, lanes);
    auto met = hn::And(active, unsure);  // none yet
    auto t_met = never, face = hn::Zero(d), place = hn::Zero(d), entering = hn::Zero(d);
    for (;;) {
      auto t = next[0];
      for (std::uint32_t i = 1; i < count; ++i) t = hn::Min(t, next[i]);
      active = hn::And(active, hn::Le(t, t_out));
      if (hn::AllFalse(d, active)) break;
      for (std::uint32_t i = count; i-- > 0;) {
        const auto crossed = hn::And(active, hn::Eq(next[i], t));
        const auto leaving = hn::Eq(leave[i], t);
        state = hn::Xor(state, hn::IfThenElseZero(hn::RebindMask(u, crossed), hn::Set(u, std::uint64_t{1} << i)));
        next[i] = hn::IfThenElse(crossed, hn::IfThenElse(leaving, never, leave[i]), next[i]);
        place = hn::IfThenElse(crossed, hn::Set(d, static_cast<double>(i)), place);
        face = hn::IfThenElse(crossed, hn::IfThenElse(leaving, leave_face[i], enter_face[i]), face);
        entering = hn::IfThenElse(crossed, hn::IfThenElse(leaving, hn::Zero(d), hn::Set(d, 1.0)), entering);
      }
      const auto value = hn::And(hn::Shr(table, state), one);
      const auto changed = hn::And(active, hn::Not(hn::RebindMask(d, hn::Eq(value, before))));
      t_met = hn::IfThenElse(changed, t, t_met);
      met = hn::Or(met, changed);
      active = hn::AndNot(changed, active);
      if (hn::AllFalse(d, active)) break;
    }
    if (count > 1 && !hn::AllFalse(d, met)) {
      // Of all ends, the one met alone may be so near.
      auto ends = hn::Zero(d);
      const auto unit = hn::Set(d, 1.0);
      for (std::uint32_t i = 0; i < count; ++i) {
        ends = hn::Add(ends, hn::IfThenElseZero(hn::Le(hn::Abs(hn::Sub(enter[i], t_met)), near), unit));
        ends = hn::Add(ends, hn::IfThenElseZero(hn::Le(hn::Abs(hn::Sub(leave[i], t_met)), near), unit));
      }
      unsure = hn::Or(unsure, hn::And(met, hn::Gt(ends, unit)));
    }
    unsure = hn::And(unsure, lanes);
    if (!hn::AllFalse(d, unsure)) DropLanes(Bits(unsure));
    const auto best = hn::Load(d, best_t_);
    const auto better = hn::And(hn::AndNot(unsure, met), hn::Lt(t_met, best));
    const std::uint32_t bits = Bits(better);
    if (bits == 0) return;
    hn::Store(hn::IfThenElse(better, t_met, best), d, best_t_);
    hn::Store(hn::IfThenElse(better, place, hn::Load(d, place_)), d, place_);
    hn::Store(hn::IfThenElse(better, face, hn::Load(d, face_)), d, face_);
    hn::Store(hn::IfThenElse(better, entering, hn::Load(d, entering_)), d, entering_);
    const auto was_inside = hn::IfThenElseZero(hn::RebindMask(d, hn::Eq(before, one)), hn::Set(d, 1.0));
    hn::Store(hn::IfThenElse(better, was_inside, hn::Load(d, before_)), d, before_);
    // Nothing behind the boundary counts; rounded up, for cells whose boxes overlap by the slack.
    const F f;
    const auto end = hn::Mul(hn::Sub(t_met, start_), hn::Set(d, 1 + 0x1p-20));
    HWY_ALIGN float shorter[width];
    hn::Store(hn::DemoteTo(f, hn::IfThenElse(better, end, hn::Zero(d))), f, shorter);
    for (std::size_t lane = 0; lane < width; ++lane) {
      if ((bits >> lane & 1) == 0) continue;
      found_[lane] = index;
      end_[lane] = std::min(end_[lane], shorter[lane]);
    }
  }

  static constexpr std::size_t most_depth = 64;

  const CellTree& cells_;
  RayLanes<D> ray_{};
  hn::Vec<D> start_{}, length_{};
  int backward_[3] = {};
  HWY_ALIGN float origin_[3][width] = {};
  HWY_ALIGN float inverse_[3][width] = {};
  HWY_ALIGN float end_[width] = {};
  HWY_ALIGN double best_t_[width] = {};
  HWY_ALIGN double place_[width] = {};
  HWY_ALIGN double face_[width] = {};
  HWY_ALIGN double entering_[width] = {};
  HWY_ALIGN double before_[width] = {};
  std::uint32_t found_[width] = {};
  std::uint32_t unsure_ = 0;
  std::uint64_t visited_ = 0, tests_ = 0;
  std::array<Entry, most_depth*(node_width - 1) + 1> stack_;
};

void TraceFirst(const CellTree& cells, const CsgTree& tree, std::span<const RayQuery> queries,
                std::span<CellAnswer> answers, bool faces_wanted, CellScratch& scratch,
                TraversalStatistics& statistics) {
  scratch.runs.clear();
  SingleTracer single(cells, tree, scratch, faces_wanted);
  constexpr std::size_t width = PacketTracer::width;
  std::size_t i = 0;
  if (width >= 4 && queries.size() >= width) {
    PacketTracer packet(cells);
    for (; i + width <= queries.size(); i += width) {
      const bool together = packet.Trace(&queries[i], &answers[i], statistics);
      for (std::size_t k = i; k < i + width; ++k) {
        if (together && answers[k].kind != CellAnswer::Kind::unsure) continue;
        answers[k] = single.Trace(queries[k], statistics[queries[k].kind]);
      }
    }
  }
  for (; i < queries.size(); ++i) answers[i] = single.Trace(queries[i], statistics[queries[i].kind]);
}

}  // namespace HWY_NAMESPACE
}  // namespace tenon::cells
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace tenon::cells {

HWY_EXPORT(TraceFirst);

void trace_first(const CellTree& cells, const CsgTree& tree, std::span<const RayQuery> queries,
                 std::span<CellAnswer> answers, bool faces_wanted, CellScratch& scratch,
                 TraversalStatistics& statistics) {
  HWY_DYNAMIC_DISPATCH(TraceFirst)(cells, tree, queries, answers, faces_wanted, scratch, statistics);
}

}  // namespace tenon::cells
#endif
