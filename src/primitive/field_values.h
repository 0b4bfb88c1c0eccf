#pragma once

#include <cstdint>
#include <span>

#include "tenon/primitive/primitive_store.h"

namespace tenon {

/// Of the values of a primitive's fields, what a hash index asks: equal values have the same hash.
std::uint64_t hash_of(std::span<const FieldValue> values);

/// Meshes are equal by what they hold.
bool are_equal(std::span<const FieldValue> a, std::span<const FieldValue> b);

}  // namespace tenon
