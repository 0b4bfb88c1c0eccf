#pragma once

#include <vector>

#include "math/enclosure.h"
#include "primitive/capsule.h"
#include "primitive/edge_crossings.h"
#include "primitive/local_ray.h"
#include "primitive/outline_edges.h"

namespace tenon {

/// How a twisted prism moves its outline, as a share of its height goes from 0 to 1.
struct TwistedSweep {
  double low = 0;            ///< z at the share 0
  double per_height = 1;     ///< 1 / height
  double quarter_turns = 0;  ///< in all
  double growth_x = 0, growth_y = 0;
  double clearance = 0, reach = 0;  ///< walls lie at these distances from the axis, or between them
};

/// A ray as it runs through the plane of the outline. At t it is at U(t) / S(t), with S the product of the two scales
/// and U = R(turn) (x scale_y, y scale_x), so that nothing is divided, and a tip is no exception.
///
/// Where it crosses an edge is isolated by halving: of an interval over which the edge's function cannot vanish there
/// is nothing to report, of one over which it is monotonic at most one crossing. Newton's method finds it, and signs on
/// either side prove it; where they do not, Newton's operator narrows it down (Moore, "Interval Analysis", 1966). An
/// interval of which neither is certain and which is no wider than the errors is reported as a crossing in doubt.
class TwistedLine {
 public:
  TwistedLine(const TwistedSweep& sweep, const LocalRay& ray, int on_edge);

  struct Interval {
    double begin, end;

    double middle() const { return 0.5 * begin + 0.5 * end; }
    double half_width() const { return 0.5 * (end - begin); }
    bool contains(double t) const { return begin <= t && t <= end; }
  };

  /// Finds the crossings with all edges within a window.
  /// @param whole  where they may be at all: halved in the same way whatever the window, so that crossings have the
  ///               same bits, unless the line runs along a wall for longer than there are looks for
  void cross_edges(const OutlineEdges& edges, const Interval& whole, const LineWindow& window,
                   std::vector<EdgeCrossing>& out);

 private:
  template <class Number>
  struct Motion {
    Number ux, uy, s;
  };

  Ball coordinate(int axis, double t, double half_width) const;
  template <class Arithmetic>
  Motion<typename Arithmetic::Number> move(const Arithmetic& with, const typename Arithmetic::Number (&point)[3]) const;
  Motion<Enclosure> move_over(const Interval& interval) const;
  Motion<Ball> move_within(const Interval& interval) const;

  template <class Arithmetic>
  static typename Arithmetic::Number edge_function(const Arithmetic& with, const OutlineEdge& edge,
                                                   const Motion<typename Arithmetic::Number>& motion);
  Enclosure edge_over(const OutlineEdge& edge, const Interval& interval) const;
  Ball edge_at(const OutlineEdge& edge, double t) const;
  Dual edge_dual(const OutlineEdge& edge, double t) const;

  /// The way of the line in the plane of the outline over an interval, in any sweep, by boxes alone.
  struct EnclosedWay {
    Motion<Enclosure> motion;

    bool may_touch(const Vec2& lower, const Vec2& upper) const;
    static bool may_cross(const OutlineEdge&) { return true; }
  };

  EdgeCrossing start_on(std::uint32_t index, const OutlineEdge& edge, const Interval& within) const;
  int parts_beside_walls(const Interval& whole, Interval (&parts)[2]) const;
  /// The same of a sweep that does not scale.
  Capsule straight_way(const Interval& interval) const;
  template <class Way>
  void search(const OutlineEdges& edges, const Interval& interval, double turn, std::vector<EdgeCrossing>& out);
  bool is_in_doubt(const OutlineEdge& edge, const Interval& interval, const Enclosure& f) const;
  void cross_edge(std::uint32_t index, const OutlineEdge& edge, const Interval& interval, const Enclosure& f, int depth,
                  std::vector<EdgeCrossing>& out);
  void cross_start(std::uint32_t index, const OutlineEdge& edge, const Interval& interval, const Enclosure& f,
                   int depth, std::vector<EdgeCrossing>& out);
  void narrow_down(std::uint32_t index, const OutlineEdge& edge, const Interval& interval, const Enclosure& f,
                   std::vector<EdgeCrossing>& out) const;
  double approach(const OutlineEdge& edge, const Interval& interval, double share) const;
  bool is_proven_near(const OutlineEdge& edge, const Interval& interval, double place, Interval& around) const;
  bool narrow_by_enclosures(const OutlineEdge& edge, Enclosure f, Interval& interval, double& place) const;
  struct Along {
    bool may_be_there = true, is_there = true;
  };
  Along along_edge(const OutlineEdge& edge, const Interval& interval) const;
  Interval clip_to_edge(const OutlineEdge& edge, Interval interval) const;
  void report(std::uint32_t index, const OutlineEdge& edge, double t, const Interval& interval, bool rising, bool sure,
              std::vector<EdgeCrossing>& out) const;

  TwistedSweep sweep_;
  LocalRay ray_;
  int on_edge_;
  LineWindow window_;
  double turn_per_t_;  // of the plane of the outline, in radians
  int looks_ = 0;
};

}  // namespace tenon
