#pragma once

#include "lang/module_arguments.h"

namespace tenon::lang {

/// Warns of children of a module that takes none: they are dropped.
void warn_of_children(ModuleCall& call);

/// A primitive, or a warning and nothing where its size makes none.
Solid add_primitive(ModuleEvaluator& evaluator, Place at, std::string_view kind, const std::vector<FieldValue>& values);
/// The one that a call without children makes.
Solid make_primitive(ModuleCall& call, std::string_view kind, const std::vector<FieldValue>& values);

/// The number given for a parameter. As in OpenSCAD, what is no number is as if it had not been given, but not
/// silently.
std::optional<double> number_argument(ModuleCall& call, const ModuleArguments& arguments, std::size_t index,
                                      std::string_view name);

/// A radius, or half of a diameter; the diameter goes first.
std::optional<double> radius_argument(ModuleCall& call, const ModuleArguments& arguments, std::size_t r, std::size_t d,
                                      std::string_view name);

}  // namespace tenon::lang
