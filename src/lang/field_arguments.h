#pragma once

#include "lang/module_arguments.h"
#include "tenon/primitive/primitive_store.h"

namespace tenon::lang {

/// The value that an argument gives to a field of a primitive, of the type of the field's fallback, which it is where
/// none is given. Fails, with what is wanted, when the argument has another type.
FieldValue require_field(const ModuleArguments& arguments, std::size_t index, const FieldInfo& field);

}  // namespace tenon::lang
