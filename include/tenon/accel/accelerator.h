#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "tenon/accel/screen_view.h"
#include "tenon/base/error.h"
#include "tenon/base/function_ref.h"
#include "tenon/base/statistics.h"
#include "tenon/csg/hit.h"
#include "tenon/math/ray.h"

namespace tenon {

struct CsgTree;

/// A ray, and what is known about it beforehand.
struct RayQuery {
  Ray ray;
  double t_max = std::numeric_limits<double>::infinity();  ///< what lies at or behind it does not count
  RayKind kind = RayKind::primary;
  int pixel_x = 0, pixel_y = 0;  ///< primary rays: where they pass the screen
  const Hit* from = nullptr;     ///< the hit the ray starts at; none when it starts in free space
};

/// What one thread needs to trace rays through one accelerator: scratch memory and counters.
class TraceContext {
 public:
  virtual ~TraceContext() = default;
  TraversalStatistics statistics;

 protected:
  TraceContext() = default;
  TraceContext(const TraceContext&) = default;
  TraceContext& operator=(const TraceContext&) = default;
};

/// What a structure says about itself once it is built.
struct AcceleratorFigures {
  std::size_t memory_bytes = 0;
  std::size_t boxes = 0;  ///< boxes, cells or nodes
  int depth = 0;

  /// What else a structure has to say: what it counts, and how many.
  struct Detail {
    std::string what;
    double value = 0;
  };
  std::vector<Detail> details;
  std::string note = {};  ///< what else there is to know, such as that another structure does the work; mostly empty
};

/// The first boundary of the solid along a ray, without what only shading needs: t and surface are those of the Hit.
struct RayBoundary {
  double t = std::numeric_limits<double>::infinity();  ///< infinite when there is none
  LeafFace surface;
  bool entering = false;  ///< the ray enters the solid (or another medium of it)

  bool found() const { return t < std::numeric_limits<double>::infinity(); }
};

/// Whether a boundary stops a shadow ray. Called once for each boundary on the way, in any order.
using StopsRay = FunctionRef<bool(const Hit&)>;

/// A spatial structure over the primitives of a CSG tree: it decides in which order they are revealed to a ray, and so
/// when the ray may stop. Immutable once built and shared by threads, each with its own context.
///
/// Every structure gives the same answers, bit for bit, as `none`; but of the error of t (Hit::bound) each tells the
/// bound that it knows.
class Accelerator {
 public:
  virtual ~Accelerator() = default;

  virtual std::unique_ptr<TraceContext> make_context() const = 0;

  /// For each query the first boundary of the solid at t > 0, before t_max; Hit::found() is false where there is none.
  /// `hits` has the length of `queries`.
  virtual void first_hits(std::span<const RayQuery> queries, std::span<Hit> hits, TraceContext& context) const = 0;

  /// The same boundaries, for those who want no more of them: normals and materials cost time.
  /// `boundaries` has the length of `queries`.
  virtual void first_boundaries(std::span<const RayQuery> queries, std::span<RayBoundary> boundaries,
                                TraceContext& context) const;

  /// Whether there is any boundary at 0 < t < t_max, 1 or 0 for each query: shadow rays where nothing is transparent.
  /// `answers` has the length of `queries`.
  virtual void occluded(std::span<const RayQuery> queries, std::span<std::uint8_t> answers,
                        TraceContext& context) const;

  /// True as soon as `stops` returned true for a boundary at 0 < t < t_max.
  virtual bool any_hit(const RayQuery& query, StopsRay stops, TraceContext& context) const = 0;

  /// Whether a shadow ray may be asked for piece by piece, one boundary and then what lies behind it, instead of all
  /// boundaries by any_hit(): where not, a piece that starts at a boundary is answered otherwise than the whole ray.
  virtual bool answers_piecewise() const { return true; }

  /// The parts of the ray (t >= 0) inside the solid, sorted. A ray that starts inside has t_in = 0 there.
  virtual void all_spans(const RayQuery& query, std::vector<SolidSpan>& spans, TraceContext& context) const = 0;

  virtual AcceleratorFigures figures() const = 0;

  bool occluded(const RayQuery& query, TraceContext& context) const {
    std::uint8_t answer = 0;
    occluded({&query, 1}, {&answer, 1}, context);
    return answer != 0;
  }

  Hit first_hit(const RayQuery& query, TraceContext& context) const {
    Hit hit;
    first_hits({&query, 1}, {&hit, 1}, context);
    return hit;
  }
};

/// What a program uses when nobody chose: by `tenon compare` and `./dev bench` the fastest on nearly all scenes.
inline constexpr std::string_view default_accelerator = "cells";

/// The names `build_accelerator` knows.
std::vector<std::string_view> accelerator_names();

/// One line that says what the structure of this name is, and its source.
std::string_view accelerator_doc(std::string_view name);
/// Every structure by itself and with every option worth testing: what the battery of tests runs.
std::vector<std::string> accelerator_specs();

/// Builds a structure.
/// @param spec  `NAME[:key=value,...]`, as the command line has it
/// @param tree  the scene; outlives the structure
/// @param view  the camera its primary rays will come from (RayQuery::pixel_x, pixel_y); none: no such filters
/// @return the structure, or a usage error: an unknown name or option, with what there is instead
Result<std::unique_ptr<Accelerator>> build_accelerator(std::string_view spec, const CsgTree& tree,
                                                       const ScreenView* view = nullptr);

}  // namespace tenon
