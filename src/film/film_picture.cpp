#include "tenon/film/film_picture.h"

#include <algorithm>
#include <cassert>

namespace tenon {

namespace {

// Fills channels from a film, pixel by pixel.
class PictureMaker {
 public:
  PictureMaker(const Film& film, Picture& picture) : film_(film), planes_(film.planes()), picture_(picture) {}

  void add_colour(ChannelType type) {
    add_means({"R", "G", "B"}, planes_.light, type);
    add_mean("A", planes_.alpha, type);
  }

  void add(Layer layer, ChannelType type) {
    switch (layer) {
      case Layer::depth:
        return add_values("Z", planes_.depth);
      case Layer::normal:
        return add_means({"N.X", "N.Y", "N.Z"}, planes_.normal, type);
      case Layer::point:
        for (std::size_t c = 0; c < 3; ++c) add_values(std::array{"P.X", "P.Y", "P.Z"}[c], planes_.point[c]);
        return;
      case Layer::albedo:
        return add_means({"albedo.R", "albedo.G", "albedo.B"}, planes_.albedo, type);
      case Layer::ids:
        for (std::size_t c = 0; c < 3; ++c) {
          add_numbers(std::array{"id.primitive", "id.material", "id.solid"}[c], planes_.ids[c]);
        }
        return;
      case Layer::crossings:
        return add_mean("crossings", planes_.crossings, ChannelType::float32);
      case Layer::path_length:
        return add_mean("path_length", planes_.path_length, ChannelType::float32);
      case Layer::samples:
        return add_numbers("samples", planes_.samples);
      case Layer::variance:
        return add_variance();
      case Layer::sums:
        return;
    }
  }

 private:
  static double number(std::uint64_t sum) { return static_cast<double>(sum); }
  template <class Integer, int bits>
  static double number(const ExactSum<Integer, bits>& sum) {
    return sum.value();
  }

  PictureChannel& channel(const char* name, ChannelType type) {
    return picture_.channels.emplace_back(PictureChannel{name, type, {}, {}});
  }

  template <class Sum>
  void add_mean(const char* name, const FilmPlanes::Plane<Sum>& sums, ChannelType type) {
    std::vector<float>& values = channel(name, type).values;
    values.resize(sums.size());
    for (std::size_t i = 0; i < sums.size(); ++i) {
      const std::uint32_t n = planes_.samples[i];
      values[i] = n == 0 ? 0.0F : static_cast<float>(number(sums[i]) / n);
    }
  }
  template <class Sum>
  void add_means(const std::array<const char*, 3>& names, const FilmPlanes::Three<Sum>& sums, ChannelType type) {
    for (std::size_t c = 0; c < 3; ++c) add_mean(names[c], sums[c], type);
  }
  void add_values(const char* name, const FilmPlanes::Plane<float>& values) {
    channel(name, ChannelType::float32).values.assign(values.begin(), values.end());
  }
  void add_numbers(const char* name, const FilmPlanes::Plane<std::uint32_t>& numbers) {
    channel(name, ChannelType::uint32).numbers.assign(numbers.begin(), numbers.end());
  }

  void add_variance() {
    add_three({"variance.R", "variance.G", "variance.B"}, [this](int x, int y) { return film_.variance(x, y); });
    add_three({"error.R", "error.G", "error.B"}, [this](int x, int y) { return film_.error(x, y); });
  }
  template <class Value>
  void add_three(const std::array<const char*, 3>& names, const Value& value) {
    const std::size_t begin = picture_.channels.size();
    for (const char* name : names) channel(name, ChannelType::float32).values.reserve(planes_.samples.size());
    const PixelWindow& window = film_.window();
    for (int y = window.y0; y < window.y1; ++y) {
      for (int x = window.x0; x < window.x1; ++x) {
        const Rgb three = value(x, y);
        picture_.channels[begin].values.push_back(static_cast<float>(three.r));
        picture_.channels[begin + 1].values.push_back(static_cast<float>(three.g));
        picture_.channels[begin + 2].values.push_back(static_cast<float>(three.b));
      }
    }
  }

  const Film& film_;
  const FilmPlanes& planes_;
  Picture& picture_;
};

}  // namespace

Picture film_picture(const Film& film, const Layers& layers, int bits) {
  Picture picture{film.width(), film.height(), film.window(), {}, {}};
  const ChannelType type = bits == 16 ? ChannelType::half : ChannelType::float32;
  PictureMaker maker(film, picture);
  maker.add_colour(type);
  for (const LayerName& name : layer_names()) {
    if (layers.has(name.layer)) maker.add(name.layer, type);
  }
  return picture;
}

DisplayPixels display_pixels(const Picture& picture, const ToneMapping& mapping, bool transparent) {
  const PictureChannel* red = picture.find("R");
  const PictureChannel* green = picture.find("G");
  const PictureChannel* blue = picture.find("B");
  const PictureChannel* alpha = picture.find("A");
  assert(red != nullptr && green != nullptr && blue != nullptr);
  const auto is_part = [](float share) { return share < 1; };
  transparent = alpha != nullptr && (transparent || std::any_of(alpha->values.begin(), alpha->values.end(), is_part));
  DisplayPixels display;
  const std::size_t pixels = picture.window.pixels();
  display.rgb.reserve(3 * pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    const double share = transparent ? static_cast<double>(alpha->values[i]) : 1;
    const double weight = share > 0 ? 1 / share : 0;
    const auto light = [&](const PictureChannel* c) { return weight * static_cast<double>(c->values[i]); };
    const Rgb shown = tone_mapped({light(red), light(green), light(blue)}, mapping);
    for (const double component : {shown.r, shown.g, shown.b}) display.rgb.push_back(static_cast<float>(component));
  }
  if (transparent) display.alpha = alpha->values;
  return display;
}

}  // namespace tenon
