#pragma once

#include <memory>
#include <optional>
#include <string>

#include "base/input_file.h"

struct zip;

namespace tenon {

/// The parts of a ZIP archive.
class ZipPackage {
 public:
  explicit ZipPackage(const InputFile& file);

  /// Whether it is an archive that can be read.
  bool is_open() const { return archive_ != nullptr; }
  /// The part that is listed first; empty where there is none.
  std::string first_name() const;
  /// Names are matched without their case, as OPC has it.
  /// @return nothing where the part is not there, damaged, or unpacks to more than 1 GiB
  std::optional<std::string> read(const std::string& name) const;

 private:
  std::unique_ptr<zip, void (*)(zip*)> archive_;
};

}  // namespace tenon
