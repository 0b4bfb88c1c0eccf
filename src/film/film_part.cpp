#include "tenon/film/film_part.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdio>
#include <optional>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "tenon/film/film_picture.h"

namespace tenon {

namespace {

// Attributes of their own: what a FilmPart says beside its notes.
constexpr std::string_view taken_note = "Samples", most_note = "samplesPerPixel", done_note = "samplesDone",
                           layers_note = "layers", bits_note = "bits", background_note = "background";
constexpr std::array own_notes{taken_note, most_note, done_note, layers_note, bits_note, background_note};
constexpr std::string_view sums_prefix = "sums.";

std::string channel_name(std::string_view plane, std::size_t word) {
  return std::string(sums_prefix) + std::string(plane) + '.' + std::to_string(word);
}

// A number as unsigned words of 32 bits, the lowest first.
template <class T>
inline constexpr std::size_t words_of = sizeof(T) / sizeof(std::uint32_t);

template <class T>
std::uint32_t word(T number, std::size_t i) {
  return static_cast<std::uint32_t>(number >> (32 * i));
}
template <class Integer, int bits>
std::uint32_t word(const ExactSum<Integer, bits>& sum, std::size_t i) {
  return static_cast<std::uint32_t>(sum.units() >> (32 * i));
}

template <class T>
void put_word(T& number, std::size_t i, std::uint32_t word) {
  number |= static_cast<T>(static_cast<T>(word) << (32 * i));
}
template <class Integer, int bits>
void put_word(ExactSum<Integer, bits>& sum, std::size_t i, std::uint32_t word) {
  __extension__ using Unsigned = std::conditional_t<sizeof(Integer) == 16, unsigned __int128, std::uint64_t>;
  const auto units = static_cast<Unsigned>(sum.units()) | static_cast<Unsigned>(word) << (32 * i);
  sum = ExactSum<Integer, bits>(static_cast<Integer>(units));
}

template <class T>
void write_plane(std::string_view name, const FilmPlanes::Plane<T>& plane, Picture& picture) {
  if (plane.empty()) return;
  if constexpr (std::is_same_v<T, float>) {
    picture.channels.push_back({channel_name(name, 0), ChannelType::float32, {plane.begin(), plane.end()}, {}});
  } else {
    for (std::size_t i = 0; i < words_of<T>; ++i) {
      std::vector<std::uint32_t> numbers(plane.size());
      for (std::size_t p = 0; p < plane.size(); ++p) numbers[p] = word(plane[p], i);
      picture.channels.push_back({channel_name(name, i), ChannelType::uint32, {}, std::move(numbers)});
    }
  }
}

// False where the picture lacks some of the plane's words. A picture that has none of them has no such plane.
template <class T>
bool read_plane(std::string_view name, const Picture& picture, FilmPlanes::Plane<T>& plane) {
  const PictureChannel* channel = picture.find(channel_name(name, 0));
  if (channel == nullptr) return true;
  if constexpr (std::is_same_v<T, float>) {
    plane.assign(channel->values.begin(), channel->values.end());
    return plane.size() == picture.window.pixels();
  } else {
    plane.resize(picture.window.pixels());
    for (std::size_t i = 0; i < words_of<T>; ++i) {
      channel = picture.find(channel_name(name, i));
      if (channel == nullptr || channel->numbers.size() != plane.size()) return false;
      for (std::size_t p = 0; p < plane.size(); ++p) put_word(plane[p], i, channel->numbers[p]);
    }
    return true;
  }
}

std::string box_text(const SampleBox& box) {
  std::string text;
  for (const int side : {box.window.x0, box.window.y0, box.window.x1, box.window.y1}) {
    text += std::to_string(side) + ',';
  }
  return text + std::to_string(box.first) + ',' + std::to_string(box.end);
}

// Numbers with commas between them; nothing where one is no whole number.
std::optional<std::vector<std::int64_t>> parse_integers(std::string_view text) {
  std::vector<std::int64_t> numbers;
  for (;;) {
    const std::size_t comma = std::min(text.find(','), text.size());
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + comma, number);
    if (error != std::errc() || end != text.data() + comma) return std::nullopt;
    numbers.push_back(number);
    if (comma == text.size()) return numbers;
    text.remove_prefix(comma + 1);
  }
}

// Only boxes of samples that there can be: in the window, of as many samples as the picture has.
std::optional<std::vector<SampleBox>> parse_boxes(std::string_view text, const PixelWindow& window,
                                                  std::uint32_t samples) {
  std::vector<SampleBox> boxes;
  while (!text.empty()) {
    const std::size_t space = std::min(text.find(' '), text.size());
    const auto n = parse_integers(text.substr(0, space));
    if (!n || n->size() != 6) return std::nullopt;
    const auto& v = *n;
    const bool inside = window.x0 <= v[0] && v[0] < v[2] && v[2] <= window.x1 && window.y0 <= v[1] && v[1] < v[3] &&
                        v[3] <= window.y1 && 0 <= v[4] && v[4] < v[5] && v[5] <= samples;
    if (!inside) return std::nullopt;
    boxes.push_back({{static_cast<int>(v[0]), static_cast<int>(v[1]), static_cast<int>(v[2]), static_cast<int>(v[3])},
                     static_cast<std::uint32_t>(v[4]),
                     static_cast<std::uint32_t>(v[5])});
    text.remove_prefix(std::min(space + 1, text.size()));
  }
  return boxes;
}

Layers kept_layers(const FilmPlanes& planes) {
  Layers layers;
  if (!planes.depth.empty()) layers.add(Layer::depth);
  if (!planes.normal[0].empty()) layers.add(Layer::normal);
  if (!planes.point[0].empty()) layers.add(Layer::point);
  if (!planes.albedo[0].empty()) layers.add(Layer::albedo);
  if (!planes.ids[0].empty()) layers.add(Layer::ids);
  if (!planes.crossings.empty()) layers.add(Layer::crossings);
  if (!planes.path_length.empty()) layers.add(Layer::path_length);
  if (!planes.squares[0].empty()) layers.add(Layer::variance);
  return layers;
}

bool planes_are_whole(const FilmPlanes& planes, std::size_t pixels) {
  const FilmPlanes expected = Film(1, 1, {0, 0, 1, 1}, kept_layers(planes)).planes();
  bool whole = true;
  const auto check = [&](std::string_view, auto plane_of) {
    whole = whole && plane_of(planes).size() == pixels * plane_of(expected).size();
  };
  for_each_sum(check);
  for_each_first(check);
  return whole;
}

}  // namespace

bool FilmPart::is_complete() const {
  return done.size() == 1 && done[0] == SampleBox{{0, 0, film.width(), film.height()}, 0, samples};
}

double FilmPart::share() const {
  std::uint64_t sum = 0;
  for (const SampleBox& box : done) sum += box.samples();
  return static_cast<double>(sum) / (static_cast<double>(film.width()) * film.height() * samples);
}

PictureNote samples_note(const FilmPart& part) {
  const double taken = part.film.mean_samples();
  char text[64];
  if (taken == part.samples) {
    std::snprintf(text, sizeof text, "%u a pixel", part.samples);
  } else {
    std::snprintf(text, sizeof text, "%.1f of %u a pixel", taken, part.samples);
  }
  return {std::string(taken_note), text};
}

Picture part_picture(const FilmPart& part) {
  Picture picture = film_picture(part.film, part.layers, part.bits);
  picture.notes = part.notes;
  picture.notes.push_back(samples_note(part));
  const bool complete = part.is_complete();
  if (complete && !part.layers.has(Layer::sums)) return picture;
  const auto write = [&](std::string_view name, auto plane_of) {
    write_plane(name, plane_of(part.film.planes()), picture);
  };
  for_each_sum(write);
  for_each_first(write);
  std::string done;
  for (const SampleBox& box : part.done) done += (done.empty() ? "" : " ") + box_text(box);
  picture.notes.push_back({std::string(most_note), std::to_string(part.samples)});
  picture.notes.push_back({std::string(layers_note), layers_text(part.layers)});
  picture.notes.push_back({std::string(bits_note), std::to_string(part.bits)});
  picture.notes.push_back({std::string(background_note), part.transparent ? "left out" : "there"});
  picture.notes.push_back({std::string(done_note), done});
  return picture;
}

Result<FilmPart> read_part(const Picture& picture, const std::string& name) {
  const auto damaged = [&](const char* what) {
    return Error{ErrorKind::input, "'" + name + "' is damaged: " + what, {}};
  };
  const std::string* samples = picture.note(most_note);
  const std::string* done = picture.note(done_note);
  const std::string* layers = picture.note(layers_note);
  const std::string* bits = picture.note(bits_note);
  const std::string* background = picture.note(background_note);
  if (samples == nullptr || done == nullptr || layers == nullptr || bits == nullptr || background == nullptr) {
    return Error{ErrorKind::input,
                 "'" + name + "' holds no exact sums; render it with --samples or --crop, or with --layers sums",
                 {}};
  }
  FilmPart part;
  const auto count = parse_integers(*samples);
  if (!count || count->size() != 1 || count->front() < 1 || count->front() > most_samples) {
    return damaged("its number of samples is wrong");
  }
  part.samples = static_cast<std::uint32_t>(count->front());
  if (*bits != "16" && *bits != "32") return damaged("its number of bits is wrong");
  part.bits = *bits == "16" ? 16 : 32;
  part.transparent = *background == "left out";
  const Result<Layers> shown = parse_layers(*layers);
  if (!shown) return damaged("its layers are wrong");
  part.layers = *shown;
  auto boxes = parse_boxes(*done, picture.window, part.samples);
  if (!boxes) return damaged("what it says is done cannot be");
  part.done = std::move(*boxes);

  FilmPlanes planes;
  bool whole = true;
  const auto read = [&](std::string_view plane, auto plane_of) {
    whole = read_plane(plane, picture, plane_of(planes)) && whole;
  };
  for_each_sum(read);
  for_each_first(read);
  if (!whole || !planes_are_whole(planes, picture.window.pixels())) return damaged("some of its sums are missing");
  const Layers kept = kept_layers(planes);
  if (!kept.contains(Layers(part.layers).remove(Layer::samples).remove(Layer::sums))) {
    return damaged("some of its sums are missing");
  }
  part.film = Film(picture.width, picture.height, picture.window, kept, std::move(planes));
  for (const PictureNote& note : picture.notes) {
    const bool own = std::find(own_notes.begin(), own_notes.end(), note.key) != own_notes.end();
    if (!own) part.notes.push_back(note);
  }
  return part;
}

}  // namespace tenon
