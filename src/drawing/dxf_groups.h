#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/input_file.h"

namespace tenon {

/// A pair of lines of a DXF file: a code, and a value.
struct DxfGroup {
  int code = 0;
  std::string_view value;
  double number = 0;  ///< of codes that have one
  int line = 0;       ///< of the value
};

/// An entity, or another thing that a group of code 0 begins, without that group.
struct DxfEntity {
  std::string_view type;
  int line = 0;
  std::span<const DxfGroup> groups;

  /// The value of the first group of a code.
  double number(int code, double fallback = 0) const {
    for (const DxfGroup& group : groups) {
      if (group.code == code) return group.number;
    }
    return fallback;
  }
  int integer(int code, int fallback = 0) const {
    const double value = number(code, fallback);
    return value >= -1e9 && value <= 1e9 ? static_cast<int>(value) : fallback;
  }
  std::string_view text(int code) const {
    for (const DxfGroup& group : groups) {
      if (group.code == code) return group.value;
    }
    return {};
  }
};

/// Reads the groups of a file.
Result<std::vector<DxfGroup>> read_dxf_groups(const InputFile& file);

/// The entities that groups make up.
std::vector<DxfEntity> entities_of(const std::vector<DxfGroup>& groups);

}  // namespace tenon
