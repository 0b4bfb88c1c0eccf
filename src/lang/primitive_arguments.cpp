#include "lang/primitive_arguments.h"

#include "lang/format.h"

namespace tenon::lang {

// OpenSCAD drops them in silence; mostly a semicolon is missing, and with it a part of the solid.
void warn_of_children(ModuleCall& call) {
  if (call.instantiation.children->instantiations.empty()) return;
  const Instantiation& dropped = *call.instantiation.children->instantiations.front();
  const std::string name = call.evaluator.environment().text(call.instantiation.name);
  call.evaluator.environment().warn(
      dropped.at, name + "() has no children; what stands here is dropped (is a ';' missing after " + name + "()?)");
}

Solid add_primitive(ModuleEvaluator& evaluator, Place at, std::string_view kind,
                    const std::vector<FieldValue>& values) {
  const PrimitiveKind& of_kind = *PrimitiveStore::find_kind(kind);
  const Result<PrimitiveId> made = evaluator.builder().model().graph.primitives.add(of_kind, values);
  if (made) return evaluator.builder().leaf(*made);
  // A solid of no volume is nothing, as in OpenSCAD; a surface that is none is a mistake.
  if (of_kind.surface) fail(at, made.error().message);
  evaluator.environment().warn(at, made.error().message);
  return Solid::nothing();
}

Solid make_primitive(ModuleCall& call, std::string_view kind, const std::vector<FieldValue>& values) {
  warn_of_children(call);
  return add_primitive(call.evaluator, call.at(), kind, values);
}

std::optional<double> number_argument(ModuleCall& call, const ModuleArguments& arguments, std::size_t index,
                                      std::string_view name) {
  if (!arguments.given(index)) return std::nullopt;
  if (const double* number = arguments[index].number()) return *number;
  Environment& environment = call.evaluator.environment();
  environment.warn(arguments.at(index), "'" + std::string(name) + "' must be a number, not " +
                                            format_value(arguments[index], environment.symbols) + "; it is ignored");
  return std::nullopt;
}

std::optional<double> radius_argument(ModuleCall& call, const ModuleArguments& arguments, std::size_t r, std::size_t d,
                                      std::string_view name) {
  const auto diameter = number_argument(call, arguments, d, "d" + std::string(name.substr(1)));
  const auto radius = number_argument(call, arguments, r, name);
  if (diameter && radius) {
    call.evaluator.environment().warn(arguments.at(r),
                                      "'" + std::string(name) + "' is ignored where the diameter is given too");
  }
  return diameter ? std::optional(*diameter / 2) : radius;
}

}  // namespace tenon::lang
