#include "lang/module_arguments.h"

#include <algorithm>
#include <cmath>

#include "tenon/base/suggestion.h"

namespace tenon::lang {

ModuleArguments::ModuleArguments(ModuleCall& call, std::span<const std::string_view> names, UnknownArgument unknown)
    : values_(names.size()), places_(names.size(), call.at()) {
  Environment& environment = call.evaluator.environment();
  std::vector<std::pair<Symbol, Value>> specials;
  const auto reject = [&](Place at, const std::string& message) {
    if (unknown == UnknownArgument::fail) fail(at, message);
    environment.warn(at, message + "; it is ignored");
  };
  std::size_t position = 0;
  for (const Argument& argument : call.instantiation.arguments) {
    Value value = call.evaluator.expressions().evaluate(*argument.value, call.scope);
    if (argument.name && environment.symbols.is_special(argument.name)) {
      specials.emplace_back(argument.name, std::move(value));
      continue;
    }
    std::size_t slot = 0;
    if (!argument.name) {
      slot = position++;
    } else {
      const auto found = std::find(names.begin(), names.end(), environment.text(argument.name));
      slot = static_cast<std::size_t>(found - names.begin());
    }
    const std::string module = environment.text(call.instantiation.name);
    if (slot < names.size()) {
      values_[slot] = std::move(value);
      places_[slot] = argument.at;
    } else if (argument.name) {
      const std::string& name = environment.text(argument.name);
      std::string instead = suggestion(name, {names.begin(), names.end()});
      if (instead.empty() && !names.empty()) {
        for (const std::string_view there_is : names)
          instead += (instead.empty() ? "; there is " : ", ") + std::string(there_is);
      }
      reject(argument.at, module + "() has no parameter '" + name + "'" + instead);
    } else {
      reject(argument.at, module + "() has only " + std::to_string(names.size()) + " parameters");
    }
  }
  for (auto& [name, value] : specials) environment.dynamics.push(name, std::move(value));
}

void refuse_children(const ModuleCall& call) {
  if (call.instantiation.children->instantiations.empty()) return;
  const std::string name = call.evaluator.environment().text(call.instantiation.name);
  fail(call.at(), name + "() takes no children, for it holds for the whole scene; end it with ';'");
}

std::optional<Vec3> to_vec3(const Value& value, std::optional<double> fallback_z) {
  const List* list = value.list();
  if (!list) return std::nullopt;
  const std::size_t n = list->items().size();
  if (n != 3 && !(n == 2 && fallback_z)) return std::nullopt;
  Vec3 v{0, 0, fallback_z.value_or(0)};
  for (std::size_t i = 0; i < n; ++i) {
    const double* number = list->items()[i].number();
    if (!number || !std::isfinite(*number)) return std::nullopt;
    v[static_cast<int>(i)] = *number;
  }
  return v;
}

double require_number(const ModuleArguments& arguments, std::size_t index, std::string_view name) {
  const double* number = arguments[index].number();
  if (!number || !std::isfinite(*number)) {
    fail(arguments.at(index), "'" + std::string(name) + "' must be a finite number, not a value of type " +
                                  std::string(arguments[index].type_name()));
  }
  return *number;
}

Vec3 require_vec3(const ModuleArguments& arguments, std::size_t index, std::string_view name) {
  const std::optional<Vec3> v = to_vec3(arguments[index]);
  if (!v)
    fail(arguments.at(index), "'" + std::string(name) + "' must be a list of three finite numbers, like [1, 2, 3]");
  return *v;
}

}  // namespace tenon::lang
