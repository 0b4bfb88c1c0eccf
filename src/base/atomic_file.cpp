#include "tenon/base/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <utility>

#include "base/note_interrupt.h"

namespace tenon {

namespace {

// Names of temporary files that exist now, for the signal handler, which may not allocate or lock.
struct TemporaryName {
  std::atomic<bool> taken{false};
  std::atomic<bool> valid{false};
  std::array<char, PATH_MAX> path{};
};
std::array<TemporaryName, 8> temporary_names;

int register_temporary(const std::string& path) {
  for (std::size_t i = 0; i < temporary_names.size(); ++i) {
    TemporaryName& name = temporary_names[i];
    if (path.size() >= name.path.size() || name.taken.exchange(true)) continue;
    std::memcpy(name.path.data(), path.c_str(), path.size() + 1);
    name.valid = true;
    return static_cast<int>(i);
  }
  return -1;
}

void unregister_temporary(int slot) {
  if (slot < 0) return;
  TemporaryName& name = temporary_names[static_cast<std::size_t>(slot)];
  name.valid = false;
  name.taken = false;
}

extern "C" void end_by_signal(int signal) {
  if (note_interrupt(signal)) return;
  for (const TemporaryName& name : temporary_names) {
    if (name.valid) unlink(name.path.data());
  }
  _exit(128 + signal);
}

Status write_all(int file, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(file, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return Error{ErrorKind::machine, std::strerror(errno), {}};
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return success();
}

std::string advice(int error) {
  switch (error) {
    case ENOENT:
    case ENOTDIR:
      return "; make its directory first, or name another";
    case EACCES:
    case EROFS:
    case EPERM:
      return "; name a place that you may write to";
    case ENOSPC:
    case EDQUOT:
      return "; make room, or name a place on another disk";
    default:
      return "";
  }
}

// mkstemp makes the file private; a picture gets what any new file of this process would.
mode_t default_mode() {
  const mode_t mask = umask(0);
  umask(mask);
  return 0666 & ~mask;
}

// Gives an open file without a name one beside `path`.
// @return the name; empty, with errno, where that cannot be
std::string name_beside(int file, const std::string& path) {
  const std::string open_file = "/proc/self/fd/" + std::to_string(file);
  for (int i = 0;; ++i) {
    std::string name = path + '.' + std::to_string(getpid()) + '.' + std::to_string(i);
    if (linkat(AT_FDCWD, open_file.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0) return name;
    if (errno != EEXIST) return "";
  }
}

// A file without a name on the disk of `path`, of which nothing is left however this process ends. A first one shows
// that such a file can be named in the end: some file systems and sandboxes allow the one and not the other.
// @return -1 where there are none
int open_unnamed(const std::string& path) {
  std::string folder = std::filesystem::path(path).parent_path().string();
  if (folder.empty()) folder = ".";
  const auto open_one = [&] { return open(folder.c_str(), O_WRONLY | O_TMPFILE | O_CLOEXEC, 0600); };
  const int first = open_one();
  if (first < 0) return -1;
  const std::string name = name_beside(first, path);
  close(first);
  if (name.empty()) return -1;
  unlink(name.c_str());
  return open_one();
}

}  // namespace

Error AtomicFile::failure(const char* doing) const {
  const int error = errno;
  return {ErrorKind::machine,
          std::string("cannot ") + doing + " '" + shown_path_ + "': " + std::strerror(error) + advice(error),
          {}};
}

Result<AtomicFile> AtomicFile::create(const std::string& path) {
  AtomicFile file;
  file.shown_path_ = path;
  file.path_ = path;
  if (char* resolved = realpath(path.c_str(), nullptr)) {
    file.path_ = resolved;
    std::free(resolved);
  }

  if (path.empty()) {
    errno = ENOENT;
    return file.failure("write");
  }
  struct stat status {};
  const bool exists = stat(file.path_.c_str(), &status) == 0;
  if (exists && S_ISDIR(status.st_mode)) {
    errno = EISDIR;
    return file.failure("write");
  }
  if (exists && !S_ISREG(status.st_mode)) {
    file.file_ = open(file.path_.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
    if (file.file_ < 0) return file.failure("write");
    return file;
  }

  file.file_ = open_unnamed(file.path_);
  file.is_unnamed_ = file.file_ >= 0;
  if (!file.is_unnamed_) {
    std::string name = file.path_ + ".XXXXXX";
    file.file_ = mkostemp(name.data(), O_CLOEXEC);
    if (file.file_ < 0) return file.failure("write");
    file.temporary_path_ = name;
    file.signal_slot_ = register_temporary(name);
  }
  if (fchmod(file.file_, exists ? status.st_mode & 07777U : default_mode()) != 0) return file.failure("write");
  return file;
}

AtomicFile::AtomicFile(AtomicFile&& other) noexcept
    : shown_path_(std::move(other.shown_path_)),
      path_(std::move(other.path_)),
      temporary_path_(std::exchange(other.temporary_path_, {})),
      is_unnamed_(std::exchange(other.is_unnamed_, false)),
      file_(std::exchange(other.file_, -1)),
      signal_slot_(std::exchange(other.signal_slot_, -1)) {}

AtomicFile::~AtomicFile() {
  if (file_ >= 0) close(file_);
  if (!temporary_path_.empty()) unlink(temporary_path_.c_str());
  unregister_temporary(signal_slot_);
}

Status AtomicFile::write(std::string_view bytes) {
  if (!write_all(file_, bytes)) return failure("write");
  return success();
}

Status AtomicFile::commit() {
  const bool replaces = is_unnamed_ || !temporary_path_.empty();
  // Some file systems find out only now that there is no room.
  if (replaces && fsync(file_) != 0) return failure("write");
  if (is_unnamed_) {
    temporary_path_ = name_beside(file_, path_);
    if (temporary_path_.empty()) return failure("put in place");
    signal_slot_ = register_temporary(temporary_path_);
  }
  if (close(std::exchange(file_, -1)) != 0) return failure("write");
  if (!replaces) return success();
  if (rename(temporary_path_.c_str(), path_.c_str()) != 0) return failure("put in place");
  temporary_path_.clear();
  unregister_temporary(std::exchange(signal_slot_, -1));
  return success();
}

Status write_standard_output(std::string_view bytes) {
  const Status status = write_all(STDOUT_FILENO, bytes);
  if (status) return success();
  return Error{ErrorKind::machine, "cannot write to standard output: " + status.error().message, {}};
}

void remove_temporary_files_on_signals() {
  struct sigaction action {};
  action.sa_handler = end_by_signal;
  sigfillset(&action.sa_mask);
  for (int signal : {SIGINT, SIGHUP, SIGTERM, SIGPIPE}) {
    struct sigaction old {};
    // A signal that whoever started us ignores (nohup) stays ignored.
    if (sigaction(signal, nullptr, &old) == 0 && old.sa_handler != SIG_IGN) sigaction(signal, &action, nullptr);
  }
  std::signal(SIGXFSZ, SIG_IGN);
}

}  // namespace tenon
