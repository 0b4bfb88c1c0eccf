#pragma once

#include <string>

#include "exchange/pov_text.h"
#include "tenon/primitive/primitive_store.h"

namespace tenon {

/// Writes a primitive in its local frame as the beginning of a POV-Ray object, `sphere { <0, 0, 0>, 1`, to which
/// modifiers and the closing brace are added.
/// @return false when POV-Ray has nothing for this kind, and nothing is written
bool print_pov_primitive(const PrimitiveStore& store, PrimitiveId id, PovText& out);

}  // namespace tenon
