#include <algorithm>
#include <cmath>

#include "lang/facets.h"
#include "lang/flat_outline.h"
#include "lang/flat_shapes.h"
#include "lang/hull_of_solids.h"
#include "lang/minkowski_of_solids.h"
#include "lang/primitive_arguments.h"
#include "lang/projection.h"
#include "plane/convex_outline.h"
#include "plane/minkowski.h"
#include "plane/offset.h"

namespace tenon::lang {

namespace {

std::optional<Solid> offset(ModuleCall& call) {
  constexpr std::string_view names[] = {"r", "delta", "chamfer"};
  const ModuleArguments arguments(call, names, UnknownArgument::warn);
  const auto r = number_argument(call, arguments, 0, "r"), delta = number_argument(call, arguments, 1, "delta");
  // As in OpenSCAD the radius goes first, and is 1 where neither is given.
  const double distance = r ? *r : delta.value_or(1);
  const OffsetJoin join = r || !delta            ? OffsetJoin::round
                          : arguments[2].truth() ? OffsetJoin::chamfer
                                                 : OffsetJoin::miter;
  if (!std::isfinite(distance)) fail(arguments.at(r ? 0 : 1), "the distance of offset() must be finite");
  if (join == OffsetJoin::round && facet_count(call.evaluator, 1) > 0) {
    call.evaluator.environment().warn(call.at(), "offset() by a radius is round here; facets of it are not supported");
  }
  const Solid shape = flat_children(call);
  return flat_solid(call.evaluator, tenon::offset(outline_of(call.evaluator, shape, call.at()), distance, join),
                    call.at());
}

std::optional<Solid> hull(ModuleCall& call) {
  ModuleEvaluator& evaluator = call.evaluator;
  const Solids parts = evaluator.children(*call.instantiation.children, call.scope);
  const bool empty = std::all_of(parts.begin(), parts.end(), [](const Solid& part) { return part.is_nothing(); });
  if (empty) return Solid::nothing();
  const Solid shape = evaluator.builder().unite(parts);
  if (!are_flat(parts)) return hull_of_solids(evaluator, shape, call.at());
  return flat_solid(evaluator, convex_hull(outline_of(evaluator, shape, call.at())), call.at());
}

std::optional<Solid> minkowski(ModuleCall& call) {
  ModuleEvaluator& evaluator = call.evaluator;
  Solids parts = evaluator.children(*call.instantiation.children, call.scope);
  std::erase_if(parts, [](const Solid& part) { return part.is_nothing(); });
  if (parts.size() < 2) return evaluator.builder().unite(parts);
  const bool flat = are_flat(parts);
  std::erase_if(parts, [&](const Solid& part) { return part.flat != flat; });
  if (!flat) return minkowski_of_solids(evaluator, parts, call.at());
  Outline sum = outline_of(evaluator, parts.front(), call.at());
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const Result<Outline> next = minkowski_sum(sum, outline_of(evaluator, parts[i], call.at()));
    if (!next) fail(call.at(), "minkowski(): " + next.error().message);
    sum = *next;
  }
  return flat_solid(evaluator, std::move(sum), call.at());
}

std::optional<Solid> projection(ModuleCall& call) {
  constexpr std::string_view names[] = {"cut", "convexity"};
  const ModuleArguments arguments(call, names, UnknownArgument::warn);
  ModuleEvaluator& evaluator = call.evaluator;
  const Solid solid = evaluator.builder().unite(evaluator.children(*call.instantiation.children, call.scope));
  if (solid.is_nothing()) return solid;
  if (solid.is_everything()) fail(call.at(), "projection() of a solid without end is not supported");
  if (solid.flat) {
    evaluator.environment().warn(call.at(),
                                 "projection() takes solids, and its children are shapes of the plane; it makes "
                                 "nothing");
    return Solid::nothing();
  }
  const bool* cut = arguments[0].boolean();
  return cut && *cut ? cut_projection(evaluator, solid, call.at()) : shadow_projection(evaluator, solid, call.at());
}

}  // namespace

void add_outline_modules(BuiltinModuleTable& table, SymbolTable& symbols) {
  table.emplace(symbols.intern("offset"), offset);
  table.emplace(symbols.intern("hull"), hull);
  table.emplace(symbols.intern("minkowski"), minkowski);
  table.emplace(symbols.intern("projection"), projection);
}

}  // namespace tenon::lang
