#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "lang/module_evaluator.h"

namespace tenon::lang {

/// What becomes of an argument that a built-in module does not know.
enum class UnknownArgument { warn, fail };

/// The arguments of a built-in module by the names of its parameters.
class ModuleArguments {
 public:
  /// Evaluates the arguments of a call. `$` arguments are set for the module and its children.
  ModuleArguments(ModuleCall& call, std::span<const std::string_view> names, UnknownArgument unknown);

  /// undef when it was not given.
  const Value& operator[](std::size_t index) const { return values_[index]; }
  bool given(std::size_t index) const { return !values_[index].is_undef(); }
  /// Of the argument, or of the call when it was not given.
  Place at(std::size_t index) const { return places_[index]; }

 private:
  std::vector<Value> values_;
  std::vector<Place> places_;
};

/// Fails where a call of a module that makes no solid has children: they would be left out.
void refuse_children(const ModuleCall& call);

/// A list of two or three finite numbers (z is `fallback_z` then); null otherwise.
std::optional<Vec3> to_vec3(const Value& value, std::optional<double> fallback_z = std::nullopt);

/// The value of an argument of one of Tenon's own modules; fails when its type is wrong.
double require_number(const ModuleArguments& arguments, std::size_t index, std::string_view name);
Vec3 require_vec3(const ModuleArguments& arguments, std::size_t index, std::string_view name);

}  // namespace tenon::lang
