#include "tenon/film/film.h"

#include <hwy/cache_control.h>

#include <cassert>
#include <cmath>
#include <string_view>

namespace tenon {

namespace {

constexpr std::uint32_t no_sample = std::numeric_limits<std::uint32_t>::max();

template <class T>
void resize(FilmPlanes::Three<T>& planes, std::size_t pixels) {
  for (auto& plane : planes) plane.resize(pixels);
}

FilmPlanes planes_for(std::size_t pixels, const Layers& layers) {
  FilmPlanes planes;
  planes.samples.resize(pixels);
  resize(planes.light, pixels);
  planes.alpha.resize(pixels);
  if (layers.has(Layer::variance)) {
    resize(planes.squares, pixels);
    planes.second_samples.resize(pixels);
    resize(planes.second_light, pixels);
  }
  if (layers.has(Layer::normal)) resize(planes.normal, pixels);
  if (layers.has(Layer::albedo)) resize(planes.albedo, pixels);
  if (layers.has(Layer::crossings)) planes.crossings.resize(pixels);
  if (layers.has(Layer::path_length)) planes.path_length.resize(pixels);
  if (keeps_first(layers)) planes.first.assign(pixels, no_sample);
  if (layers.has(Layer::depth)) planes.depth.assign(pixels, std::numeric_limits<float>::infinity());
  if (layers.has(Layer::point)) resize(planes.point, pixels);
  if (layers.has(Layer::ids)) resize(planes.ids, pixels);
  return planes;
}

// Single precision has more digits than a pixel needs, and sums of it shrink well when they are stored.
std::array<float, 3> stored(const Rgb& light) {
  return {static_cast<float>(light.r), static_cast<float>(light.g), static_cast<float>(light.b)};
}

template <class Sum, class Number>
void add_three(FilmPlanes::Three<Sum>& planes, std::size_t i, Number a, Number b, Number c) {
  if (planes[0].empty()) return;
  planes[0][i].add(a);
  planes[1][i].add(b);
  planes[2][i].add(c);
}

template <class Sum>
Rgb mean(const FilmPlanes::Three<Sum>& planes, std::size_t i, std::uint32_t samples) {
  if (samples == 0) return {};
  return {planes[0][i].value() / samples, planes[1][i].value() / samples, planes[2][i].value() / samples};
}

// Of the mean of n numbers, from their sum and that of their squares.
double squared_error(const WideSum& sum, const SquareSum& squares, double n) {
  const double value = sum.value();
  return std::max(0.0, squares.value() - value * value / n) / (n * (n - 1));
}

}  // namespace

Film::Film(int width, int height, const PixelWindow& window, const Layers& layers)
    : Film(width, height, window, layers, planes_for(window.pixels(), layers)) {}

Film::Film(int width, int height, const PixelWindow& window, const Layers& layers, FilmPlanes planes)
    : width_(width), height_(height), window_(window), layers_(layers), planes_(std::move(planes)) {}

void Film::fetch(const PixelWindow& pixels) const {
  constexpr std::size_t cache_line = 64;  // bytes
  for_each_sum([&](std::string_view, auto plane_of) {
    const auto& plane = plane_of(planes_);
    if (plane.empty()) return;
    constexpr std::size_t step = std::max(cache_line / sizeof(plane[0]), std::size_t{1});
    const auto length = static_cast<std::size_t>(pixels.width());
    for (int y = pixels.y0; y < pixels.y1; ++y) {
      const auto* row = &plane[window_.index(pixels.x0, y)];
      for (std::size_t i = 0; i < length; i += step) hwy::Prefetch(row + i);
      hwy::Prefetch(row + length - 1);
    }
  });
}

void Film::add_light(std::size_t i, const Rgb& light, double alpha) {
  ++planes_.samples[i];
  const auto [r, g, b] = stored(light);
  add_three(planes_.light, i, r, g, b);
  planes_.alpha[i].add(alpha);
}

void Film::add(int x, int y, const FilmSample& sample) {
  const std::size_t i = window_.index(x, y);
  add_light(i, sample.light, sample.alpha);
  const auto [r, g, b] = stored(sample.light);
  const auto square = [](float v) { return static_cast<double>(v) * static_cast<double>(v); };
  add_three(planes_.squares, i, square(r), square(g), square(b));
  if (sample.is_in_second_half && !planes_.second_samples.empty()) {
    ++planes_.second_samples[i];
    add_three(planes_.second_light, i, r, g, b);
  }
  add_three(planes_.normal, i, sample.normal.x, sample.normal.y, sample.normal.z);
  add_three(planes_.albedo, i, sample.albedo.r, sample.albedo.g, sample.albedo.b);
  if (!planes_.crossings.empty()) planes_.crossings[i] += sample.crossings;
  if (!planes_.path_length.empty()) {
    planes_.path_length[i].add(static_cast<float>(sample.path_length));
  }
  if (planes_.first.empty() || planes_.first[i] < sample.index) return;
  planes_.first[i] = sample.index;
  if (!planes_.depth.empty()) planes_.depth[i] = static_cast<float>(sample.depth);
  const std::array<std::uint32_t, 3> ids{sample.ids.primitive, sample.ids.material, sample.ids.solid};
  for (std::size_t c = 0; c < 3; ++c) {
    if (!planes_.point[c].empty()) planes_.point[c][i] = static_cast<float>(sample.point[static_cast<int>(c)]);
    if (!planes_.ids[c].empty()) planes_.ids[c][i] = ids[c];
  }
}

void Film::add(const Film& part) {
  assert(part.layers_ == layers_ && part.width_ == width_ && part.height_ == height_);
  const PixelWindow both = overlap(window_, part.window_);
  const auto for_each_row = [&](auto&& body) {
    const auto length = static_cast<std::size_t>(both.width());
    for (int y = both.y0; y < both.y1; ++y) body(window_.index(both.x0, y), part.window_.index(both.x0, y), length);
  };
  for_each_sum([&](std::string_view, auto plane_of) {
    auto& mine = plane_of(planes_);
    const auto& theirs = plane_of(part.planes_);
    if (mine.empty()) return;
    for_each_row([&](std::size_t to, std::size_t from, std::size_t length) {
      for (std::size_t i = 0; i < length; ++i) mine[to + i] += theirs[from + i];
    });
  });
  if (planes_.first.empty()) return;
  for_each_first([&](std::string_view, auto plane_of) {
    auto& mine = plane_of(planes_);
    const auto& theirs = plane_of(part.planes_);
    if (mine.empty()) return;
    for_each_row([&](std::size_t to, std::size_t from, std::size_t length) {
      for (std::size_t i = 0; i < length; ++i) {
        if (part.planes_.first[from + i] < planes_.first[to + i]) mine[to + i] = theirs[from + i];
      }
    });
  });
}

Film Film::cropped(const PixelWindow& window) const {
  Film film(width_, height_, window, layers_);
  film.add(*this);
  return film;
}

double Film::mean_samples() const {
  std::uint64_t sum = 0;
  for (const std::uint32_t of_pixel : planes_.samples) sum += of_pixel;
  return static_cast<double>(sum) / static_cast<double>(window_.pixels());
}

Rgb Film::light(int x, int y) const {
  return mean(planes_.light, window_.index(x, y), samples(x, y));
}

double Film::alpha(int x, int y) const {
  const std::uint32_t n = samples(x, y);
  return n == 0 ? 0 : planes_.alpha[window_.index(x, y)].value() / n;
}

Rgb Film::variance(int x, int y) const {
  const std::uint32_t n = samples(x, y);
  if (n < 2) return {};
  const std::size_t i = window_.index(x, y);
  const auto of = [&](std::size_t c) { return squared_error(planes_.light[c][i], planes_.squares[c][i], n); };
  return {of(0), of(1), of(2)};
}

Rgb Film::error(int x, int y) const {
  const std::size_t i = window_.index(x, y);
  const double n = planes_.samples[i], second = planes_.second_samples[i], first = n - second;
  if (first == 0 || second == 0) {
    const Rgb v = variance(x, y);
    return {std::sqrt(v.r), std::sqrt(v.g), std::sqrt(v.b)};
  }
  // Two means whose variances are as the inverse of their numbers differ with their sum, and the mean of all has the
  // inverse of the whole number.
  const double share = std::sqrt(first * second) / n;
  const auto of = [&](std::size_t c) {
    const double of_second = planes_.second_light[c][i].value(), of_all = planes_.light[c][i].value();
    return share * (of_second / second - (of_all - of_second) / first);
  };
  return {of(0), of(1), of(2)};
}

double Film::bytes(const PixelWindow& window, const Layers& layers) {
  const FilmPlanes one = planes_for(1, layers);
  std::size_t bytes = 0;
  const auto count = [&](std::string_view, auto plane_of) {
    const auto& plane = plane_of(one);
    bytes += plane.size() * sizeof(plane[0]);
  };
  for_each_sum(count);
  for_each_first(count);
  return static_cast<double>(bytes) * static_cast<double>(window.width()) * window.height();
}

}  // namespace tenon
