#include "ray_file.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>

namespace tenon {

namespace {

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}

// The line as it is shown under a message: what a terminal would act on is masked, the columns stay.
std::string shown(std::string_view line) {
  std::string text(line);
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return (c < 0x20 && c != '\t') || c == 0x7F; }, '?');
  return text;
}

// Reads one line, number by number.
class RayLine {
 public:
  RayLine(std::string_view line, const std::string& name, int number)
      : line_(line.substr(0, line.find('#'))), whole_(line), name_(name), number_(number) {}

  bool is_empty() {
    skip_blanks();
    return at_ == line_.size();
  }

  Result<Ray> read() {
    std::array<double, 6> values{};
    std::array<std::size_t, 6> places{};
    for (std::size_t i = 0; i < values.size(); ++i) {
      skip_blanks();
      places[i] = at_;
      if (at_ == line_.size()) {
        return error(at_, "a ray takes six numbers, ox oy oz dx dy dz, and this line has " + std::to_string(i));
      }
      const auto value = read_number();
      if (!value) return error(places[i], "this is no finite number; a ray takes six: ox oy oz dx dy dz");
      values[i] = *value;
    }
    skip_blanks();
    if (at_ != line_.size()) return error(at_, "a ray takes six numbers, ox oy oz dx dy dz, and this line has more");
    const Ray ray{{values[0], values[1], values[2]}, {values[3], values[4], values[5]}};
    if (ray.direction == Vec3{}) return error(places[3], "the direction 0 0 0 leads nowhere; give it a length");
    return ray;
  }

 private:
  void skip_blanks() {
    while (at_ < line_.size() && is_blank(line_[at_])) ++at_;
  }

  std::optional<double> read_number() {
    std::size_t end = at_;
    while (end < line_.size() && !is_blank(line_[end])) ++end;
    const std::size_t begin = line_[at_] == '+' ? at_ + 1 : at_;
    double value = 0;
    const auto [stop, error] = std::from_chars(line_.data() + begin, line_.data() + end, value);
    at_ = end;
    if (error != std::errc() || stop != line_.data() + end || !std::isfinite(value)) return std::nullopt;
    return value;
  }

  Error error(std::size_t at, std::string message) const {
    return {ErrorKind::input, std::move(message), {name_, number_, static_cast<int>(at) + 1, shown(whole_)}};
  }

  std::string_view line_, whole_;
  const std::string& name_;
  int number_;
  std::size_t at_ = 0;
};

}  // namespace

Result<std::vector<Ray>> parse_rays(std::string_view text, const std::string& name) {
  std::vector<Ray> rays;
  for (int number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    RayLine line(text.substr(0, end), name, number);
    if (!line.is_empty()) {
      Result<Ray> ray = line.read();
      if (!ray) return ray.error();
      rays.push_back(*ray);
    }
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return rays;
}

Result<std::vector<Ray>> read_rays(const std::string& path) {
  const bool is_standard_input = path == "-";
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> opened(
      is_standard_input ? nullptr : std::fopen(path.c_str(), "rb"), [](std::FILE* f) { return std::fclose(f); });
  std::FILE* file = is_standard_input ? stdin : opened.get();
  const auto failure = [&] {
    return Error{ErrorKind::input, "cannot read the rays in '" + path + "': " + std::strerror(errno), {}};
  };
  if (file == nullptr) return failure();
  std::string text;
  std::vector<char> buffer(1 << 16);
  while (const std::size_t read = std::fread(buffer.data(), 1, buffer.size(), file)) text.append(buffer.data(), read);
  if (std::ferror(file) != 0) return failure();
  return parse_rays(text, is_standard_input ? "<stdin>" : path);
}

}  // namespace tenon
