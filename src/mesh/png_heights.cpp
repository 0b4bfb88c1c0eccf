#include "mesh/png_heights.h"

#include <png.h>

#include <csetjmp>
#include <cstring>

namespace tenon {

namespace {

/// Reads one picture. libpng reports errors by a jump, so nothing in read() that it leaves behind has a destructor.
class PngReader {
 public:
  PngReader(const MeshFile& file, std::size_t most_points) : rest_(file.bytes), most_points_(most_points) {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, on_error, on_warning);
    info_ = png_ != nullptr ? png_create_info_struct(png_) : nullptr;
  }
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  bool read() {
    if (info_ == nullptr) return fail("there is no memory to read it");
    if (setjmp(png_jmpbuf(png_)) != 0) return false;  // NOLINT(cert-err52-cpp): libpng's way
    return read_values();
  }

  Heights heights;
  std::string problem;

 private:
  // Apart from read(), where a compiler cannot tell which variables the jump spares.
  [[gnu::noinline]] bool read_values() {
    png_set_read_fn(png_, this, take_bytes);
    png_read_info(png_, info_);
    heights.rows = png_get_image_height(png_, info_);
    heights.columns = png_get_image_width(png_, info_);
    if (heights.rows * heights.columns > most_points_) {
      return fail("it has more than " + std::to_string(most_points_) + " pixels; scale it down");
    }
    png_set_expand(png_);
    png_set_strip_16(png_);
    png_set_strip_alpha(png_);
    png_set_gray_to_rgb(png_);
    const int passes = png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
    pixels_.resize(heights.rows * heights.columns * 3);
    for (int pass = 0; pass < passes; ++pass) {
      for (std::size_t row = 0; row < heights.rows; ++row) {
        png_read_row(png_, pixels_.data() + row * heights.columns * 3, nullptr);
      }
    }
    for (std::size_t i = 0; i < pixels_.size(); i += 3) {
      // Rec. 709, as OpenSCAD weighs them.
      heights.values.push_back(0.2126 * pixels_[i] + 0.7152 * pixels_[i + 1] + 0.0722 * pixels_[i + 2]);
    }
    return true;
  }
  bool fail(std::string message) {
    problem = std::move(message);
    return false;
  }
  [[noreturn]] static void on_error(png_structp png, png_const_charp message) {
    static_cast<PngReader*>(png_get_error_ptr(png))->problem = message;
    png_longjmp(png, 1);
  }
  static void on_warning(png_structp /*png*/, png_const_charp /*message*/) {}
  static void take_bytes(png_structp png, png_bytep out, std::size_t count) {
    auto* self = static_cast<PngReader*>(png_get_io_ptr(png));
    if (count > self->rest_.size()) png_error(png, "the file is cut off");
    std::memcpy(out, self->rest_.data(), count);
    self->rest_.remove_prefix(count);
  }

  std::string_view rest_;
  std::size_t most_points_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  std::vector<png_byte> pixels_;
};

}  // namespace

Result<Heights> read_png_heights(const MeshFile& file, std::size_t most_points) {
  PngReader reader(file, most_points);
  if (reader.read()) return std::move(reader.heights);
  return Error{ErrorKind::input, "this PNG picture cannot be read: " + reader.problem, {file.path, 0, 0, {}}};
}

}  // namespace tenon
