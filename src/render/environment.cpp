#include "render/environment.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tenon/math/affine3.h"

namespace tenon {

namespace {

constexpr double pi = std::numbers::pi;

// How bright a colour is (the luminance of linear sRGB, IEC 61966-2-1).
double brightness(const Rgb& c) {
  return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
}

// The cell of a list of sums that holds a share of all, and how far into it.
std::pair<int, double> draw(const double* sums, int count, double share) {
  const double wanted = share * sums[count];
  const double* above = std::upper_bound(sums + 1, sums + count, wanted);
  const auto cell = static_cast<int>(above - sums) - 1;
  const double width = sums[cell + 1] - sums[cell];
  return {cell, width > 0 ? std::clamp((wanted - sums[cell]) / width, 0.0, 1.0) : 0.5};
}

}  // namespace

Environment::Environment(const Light& light) : cos_turn_(cos_degrees(light.turn)), sin_turn_(sin_degrees(light.turn)) {
  const Rgb factor = light.intensity * linear_from_srgb(light.color);
  const LightMap sky = light.kind == LightKind::sky ? sky_map(light) : LightMap{};
  const LightMap* map = light.kind == LightKind::sky ? &sky : light.map.get();
  if (map == nullptr || map->rgb.empty()) {
    pixels_ = {factor};
  } else {
    width_ = map->width;
    height_ = map->height;
    pixels_.reserve(map->rgb.size() / 3);
    for (std::size_t i = 0; i + 2 < map->rgb.size(); i += 3) {
      const Rgb light_there{map->rgb[i], map->rgb[i + 1], map->rgb[i + 2]};
      pixels_.push_back(light.kind == LightKind::sky ? light_there : factor * light_there);
    }
  }
  prepare_sampling();
}

double Environment::sin_row(int row) const {
  return std::sin(pi * (row + 0.5) / height_);
}

const Rgb& Environment::pixel(int column, int row) const {
  const int x = (column % width_ + width_) % width_, y = std::clamp(row, 0, height_ - 1);
  return pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)];
}

// A cell of the drawing is a pixel; interpolation brings its neighbours in, so they count as well, and a direction that
// sends light is never left out.
void Environment::prepare_sampling() {
  rows_.assign(1, 0);
  double up = 0, down = 0;
  for (int y = 0; y < height_; ++y) {
    cells_.push_back(0);
    double sum = 0;
    for (int x = 0; x < width_; ++x) {
      double around = 0;
      for (int i = 0; i < 9; ++i) around += brightness(pixel(x + i % 3 - 1, y + i / 3 - 1)) / 9;
      sum += around * sin_row(y);
      cells_.push_back(sum);
    }
    rows_.push_back(rows_.back() + sum);
    const double cos = std::cos(pi * (y + 0.5) / height_);
    (cos > 0 ? up : down) += sum * std::fabs(cos);
  }
  total_ = rows_.back();
  // The area of a pixel at the equator; irradiance over pi.
  const double cell = 2 * pi / width_ * (pi / height_);
  importance_ = is_uniform() ? brightness(pixels_.front()) : std::max(up, down) * cell / pi;
}

Environment::Place Environment::place_of(const Vec3& d) const {
  const double x = cos_turn_ * d.x + sin_turn_ * d.y, y = cos_turn_ * d.y - sin_turn_ * d.x;
  const double longitude = x == 0 && y == 0 ? 0 : std::atan2(x, y);
  return {(0.5 + longitude / (2 * pi)) * width_, std::acos(std::clamp(d.z, -1.0, 1.0)) / pi * height_};
}

Vec3 Environment::direction_of(const Place& place) const {
  const double longitude = (place.column / width_ - 0.5) * (2 * pi), colatitude = place.row / height_ * pi;
  const double x = std::sin(colatitude) * std::sin(longitude), y = std::sin(colatitude) * std::cos(longitude);
  return {cos_turn_ * x - sin_turn_ * y, sin_turn_ * x + cos_turn_ * y, std::cos(colatitude)};
}

Rgb Environment::radiance(const Vec3& direction) const {
  if (is_uniform()) return pixels_.front();
  const Place place = place_of(direction);
  const double left = std::floor(place.column - 0.5), top = std::floor(place.row - 0.5);
  const double x = place.column - 0.5 - left, y = place.row - 0.5 - top;
  const int column = static_cast<int>(left), row = static_cast<int>(top);
  return (1 - y) * ((1 - x) * pixel(column, row) + x * pixel(column + 1, row)) +
         y * ((1 - x) * pixel(column, row + 1) + x * pixel(column + 1, row + 1));
}

std::optional<EnvironmentSample> Environment::sample(const Sample2& place) const {
  if (!(total_ > 0)) return std::nullopt;
  const auto [row, down] = draw(rows_.data(), height_, place.v);
  const double* cells = cells_.data() + static_cast<std::size_t>(row) * (static_cast<std::size_t>(width_) + 1);
  const auto [column, across] = draw(cells, width_, place.u);
  EnvironmentSample sample;
  sample.direction = direction_of({column + across, row + down});
  sample.radiance = radiance(sample.direction);
  sample.density = density(sample.direction);
  if (!(sample.density > 0)) return std::nullopt;
  return sample;
}

double Environment::density(const Vec3& direction) const {
  const Place place = place_of(direction);
  const int row = std::clamp(static_cast<int>(place.row), 0, height_ - 1);
  const int column = std::clamp(static_cast<int>(place.column), 0, width_ - 1);
  const double* cells = cells_.data() + static_cast<std::size_t>(row) * (static_cast<std::size_t>(width_) + 1);
  // Within a row colatitude is drawn evenly, so that the density per solid angle has the sine of the place itself.
  const double sin = std::sqrt(std::max(0.0, 1 - direction.z * direction.z));
  if (!(sin > 0) || !(total_ > 0)) return 0;
  const double pixels = static_cast<double>(width_) * height_;
  return (cells[column + 1] - cells[column]) / total_ * pixels / (2 * pi * pi * sin);
}

}  // namespace tenon
