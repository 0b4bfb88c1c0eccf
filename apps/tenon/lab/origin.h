#pragma once

#include <string>

namespace tenon {

/// What figures were measured with.
struct LabOrigin {
  std::string machine;   ///< processor, cores, memory
  std::string date;      ///< UTC
  std::string compiler;  ///< and what it was told
  std::string commit;    ///< of the repository; with a "+" where files were changed since
  double load = 0;       ///< processes that wanted to run when it began, over the last minute
  int cores = 1;
};

/// @param root  of the repository
LabOrigin find_origin(const std::string& root);

}  // namespace tenon
