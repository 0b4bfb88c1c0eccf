#include <png.h>

#include <csetjmp>
#include <cstring>

#include "tenon/image/picture_file.h"

namespace tenon {

namespace {

/// Reads one PNG picture, and keeps no pixels. libpng reports errors by a jump, so nothing in read() that it leaves
/// behind has a destructor.
class PngHeadReader {
 public:
  explicit PngHeadReader(std::string_view bytes) : rest_(bytes) {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, on_error, on_warning);
    info_ = png_ != nullptr ? png_create_info_struct(png_) : nullptr;
  }
  ~PngHeadReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngHeadReader(const PngHeadReader&) = delete;
  PngHeadReader& operator=(const PngHeadReader&) = delete;

  bool read() {
    if (info_ == nullptr || setjmp(png_jmpbuf(png_)) != 0) return false;  // NOLINT(cert-err52-cpp): libpng's way
    png_set_read_fn(png_, this, take_bytes);
    png_set_user_limits(png_, 0x7FFFFFFF, 0x7FFFFFFF);
    png_read_info(png_, info_);
    const int passes = png_set_interlace_handling(png_);
    const png_uint_32 height = png_get_image_height(png_, info_);
    for (int pass = 0; pass < passes; ++pass) {
      for (png_uint_32 row = 0; row < height; ++row) png_read_row(png_, nullptr, nullptr);
    }
    png_read_end(png_, info_);
    return true;
  }

  /// Only after read().
  Picture head() const {
    Picture picture;
    picture.width = static_cast<int>(png_get_image_width(png_, info_));
    picture.height = static_cast<int>(png_get_image_height(png_, info_));
    picture.window = {0, 0, picture.width, picture.height};
    png_textp texts = nullptr;
    const int count = png_get_text(png_, info_, &texts, nullptr);
    for (int i = 0; i < count; ++i) picture.notes.push_back({texts[i].key, texts[i].text});
    return picture;
  }

  std::string problem = "there is no memory to read it";

 private:
  [[noreturn]] static void on_error(png_structp png, png_const_charp message) {
    static_cast<PngHeadReader*>(png_get_error_ptr(png))->problem = message;
    png_longjmp(png, 1);
  }
  static void on_warning(png_structp /*png*/, png_const_charp /*message*/) {}
  static void take_bytes(png_structp png, png_bytep out, std::size_t count) {
    auto* self = static_cast<PngHeadReader*>(png_get_io_ptr(png));
    if (count > self->rest_.size()) png_error(png, "it is cut off");
    std::memcpy(out, self->rest_.data(), count);
    self->rest_.remove_prefix(count);
  }

  std::string_view rest_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

}  // namespace

Result<Picture> decode_head(const std::string& bytes, const std::string& name) {
  constexpr std::string_view png_signature = "\x89PNG\r\n\x1A\n";
  if (!bytes.starts_with(png_signature)) {
    Result<Picture> picture = decode_exr(bytes, name);
    if (picture) picture->channels.clear();
    return picture;
  }
  PngHeadReader reader(bytes);
  if (reader.read()) return reader.head();
  return Error{ErrorKind::input, "'" + name + "' is no PNG picture that can be read: " + reader.problem, {}};
}

}  // namespace tenon
