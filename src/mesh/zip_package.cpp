#include "mesh/zip_package.h"

#include <zip.h>

namespace tenon {

namespace {

// An archive may say little and mean much.
constexpr std::size_t largest_part = std::size_t{1} << 30;

}  // namespace

ZipPackage::ZipPackage(const InputFile& file) : archive_(nullptr, zip_discard) {
  zip_error_t error;
  zip_error_init(&error);
  zip_source_t* source = zip_source_buffer_create(file.bytes.data(), file.bytes.size(), 0, &error);
  zip_t* archive = source != nullptr ? zip_open_from_source(source, ZIP_RDONLY, &error) : nullptr;
  if (archive == nullptr && source != nullptr) zip_source_free(source);
  zip_error_fini(&error);
  archive_.reset(archive);
}

std::string ZipPackage::first_name() const {
  const char* const name = zip_get_name(archive_.get(), 0, 0);
  return name == nullptr ? "" : name;
}

std::optional<std::string> ZipPackage::read(const std::string& name) const {
  zip_stat_t stat;
  if (zip_stat(archive_.get(), name.c_str(), ZIP_FL_NOCASE, &stat) != 0) return std::nullopt;
  if ((stat.valid & ZIP_STAT_SIZE) == 0 || stat.size > largest_part) return std::nullopt;
  const std::unique_ptr<zip_file_t, int (*)(zip_file_t*)> part(zip_fopen_index(archive_.get(), stat.index, 0),
                                                               zip_fclose);
  if (part == nullptr) return std::nullopt;
  // Read piece by piece: what the directory says of its size may be a lie.
  std::string bytes;
  char buffer[1 << 16];
  for (;;) {
    const zip_int64_t count = zip_fread(part.get(), buffer, sizeof buffer);
    if (count < 0 || bytes.size() > largest_part) return std::nullopt;
    if (count == 0) return bytes;
    bytes.append(buffer, static_cast<std::size_t>(count));
  }
}

}  // namespace tenon
