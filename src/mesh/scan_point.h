#pragma once

#include "base/text_scanner.h"
#include "tenon/math/vec3.h"

namespace tenon {

/// Three numbers from the line; nothing when one is missing or not finite. The scanner stands at the bad one then.
inline std::optional<Vec3> to_vec3(TextScanner& scanner) {
  Vec3 v;
  for (int i = 0; i < 3; ++i) {
    const auto number = to_number(scanner.word());
    if (!number) return std::nullopt;
    v[i] = *number;
  }
  return v;
}

}  // namespace tenon
