#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tenon/base/error.h"

namespace tenon::lang {

/// A scene file in memory.
struct SourceText {
  std::string name;       ///< as messages show it
  std::string directory;  ///< where files that it names are sought first
  std::string text;
  std::vector<std::uint32_t> line_starts;

  SourceText(std::string name, std::string directory, std::string text);
};

/// A place in a scene file, small enough to be kept with everything that is parsed.
struct Place {
  const SourceText* source = nullptr;
  std::uint32_t offset = 0;

  friend bool operator==(const Place&, const Place&) = default;
};

SourceLocation locate(Place at);

}  // namespace tenon::lang
