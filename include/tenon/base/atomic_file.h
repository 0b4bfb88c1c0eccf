#pragma once

#include <string>
#include <string_view>

#include "tenon/base/error.h"

namespace tenon {

/// A file that nobody ever sees half written: its bytes go to a temporary file on the same disk, which takes its name
/// when everything is written. Until then an older file of that name stays as it was; whatever goes wrong, the
/// temporary file is removed. It has no name of its own, so that nothing is left even where the process is killed; on
/// file systems that have no such files it lies beside, under the name and six letters.
///
/// Where the name is that of a device or a pipe, the bytes go straight there; a symbolic link keeps pointing where it
/// does, and the file it points at is replaced.
class AtomicFile {
 public:
  /// Makes the temporary file, so that a place that cannot be written is known before the work begins.
  static Result<AtomicFile> create(const std::string& path);
  AtomicFile(AtomicFile&& other) noexcept;
  AtomicFile& operator=(AtomicFile&&) = delete;
  ~AtomicFile();

  /// Appends bytes.
  Status write(std::string_view bytes);
  /// Puts the file in its place. Nothing can be written after.
  Status commit();

 private:
  AtomicFile() = default;
  Error failure(const char* doing) const;

  std::string shown_path_;  // as the user wrote it
  std::string path_;
  std::string temporary_path_;  // where the temporary file has a name
  bool is_unnamed_ = false;     // it gets one in commit(); if neither, path_ is written straight
  int file_ = -1;
  int signal_slot_ = -1;
};

/// Writes all bytes to standard output.
Status write_standard_output(std::string_view bytes);

/// From now on an interrupt, a hang-up, a termination or a broken pipe removes the temporary files of this process and
/// ends it with 128 + the signal's number (130 for Ctrl-C), unless an InterruptDeferral notes it. A file that grows
/// over the limit for its size is an error of write() instead of a signal.
void remove_temporary_files_on_signals();

}  // namespace tenon
