#pragma once

#include "lang/source_text.h"
#include "tenon/base/error.h"

namespace tenon::lang {

/// What ends a parse or an evaluation; caught in load.cpp and nowhere else.
struct Failure {
  Error error;
};

[[noreturn]] void fail(Place at, std::string message, ErrorKind kind = ErrorKind::input);

}  // namespace tenon::lang
