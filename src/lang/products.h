#pragma once

#include "lang/environment.h"

namespace tenon::lang {

/// `*` of two lists: the dot product of vectors, or the product of a matrix with a vector or a matrix.
Value multiply_lists(const List& left, const List& right, Place at, Environment& environment);

}  // namespace tenon::lang
