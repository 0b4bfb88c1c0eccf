#include <algorithm>
#include <tuple>

#include "tenon/film/film_part.h"

namespace tenon {

namespace {

auto order_of(const SampleBox& b) {
  return std::tuple(b.first, b.end, b.window.y0, b.window.y1, b.window.x0, b.window.x1);
}

SampleBox hull(const SampleBox& a, const SampleBox& b) {
  return {{std::min(a.window.x0, b.window.x0), std::min(a.window.y0, b.window.y0), std::max(a.window.x1, b.window.x1),
           std::max(a.window.y1, b.window.y1)},
          std::min(a.first, b.first),
          std::max(a.end, b.end)};
}

// Joins each box with the one before it where the two make a box. They are sorted, so that neighbours follow.
template <class Order>
void join_neighbours(std::vector<SampleBox>& boxes, Order order) {
  std::sort(boxes.begin(), boxes.end(), [&](const SampleBox& a, const SampleBox& b) { return order(a) < order(b); });
  std::vector<SampleBox> kept;
  for (const SampleBox& box : boxes) {
    if (!kept.empty() && hull(kept.back(), box).samples() == kept.back().samples() + box.samples()) {
      kept.back() = hull(kept.back(), box);
    } else {
      kept.push_back(box);
    }
  }
  boxes = std::move(kept);
}

bool overlaps(const SampleBox& a, const SampleBox& b) {
  return overlap(a.window, b.window).pixels() > 0 && a.first < b.end && b.first < a.end;
}

Error input_error(std::string message) {
  return {ErrorKind::input, std::move(message), {}};
}

// The first two parts that hold the same samples of a pixel, in words; empty when none do.
std::string samples_twice(const std::vector<FilmPart>& parts, const std::vector<std::string>& names) {
  struct Owned {
    SampleBox box;
    std::size_t part;
  };
  std::vector<Owned> all;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    for (const SampleBox& box : parts[i].done) all.push_back({box, i});
  }
  std::sort(all.begin(), all.end(), [](const Owned& a, const Owned& b) { return a.box.window.y0 < b.box.window.y0; });
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t k = i + 1; k < all.size() && all[k].box.window.y0 < all[i].box.window.y1; ++k) {
      if (!overlaps(all[i].box, all[k].box)) continue;
      const auto [low, high] = std::minmax(all[i].part, all[k].part);
      return "'" + names[low] + "' and '" + names[high] + "' hold the same samples; leave one of them out";
    }
  }
  return "";
}

}  // namespace

std::vector<SampleBox> joined(std::vector<SampleBox> boxes) {
  join_neighbours(boxes, order_of);
  join_neighbours(boxes, [](const SampleBox& b) {
    return std::tuple(b.first, b.end, b.window.x0, b.window.x1, b.window.y0, b.window.y1);
  });
  if (boxes.empty()) return boxes;
  // Boxes that fill their hull are one box, however they were cut.
  SampleBox all = boxes.front();
  std::uint64_t samples = 0;
  for (const SampleBox& box : boxes) all = hull(all, box), samples += box.samples();
  if (samples == all.samples()) return {all};
  std::sort(boxes.begin(), boxes.end(),
            [](const SampleBox& a, const SampleBox& b) { return order_of(a) < order_of(b); });
  return boxes;
}

std::string picture_difference(const FilmPart& a, const FilmPart& b) {
  if (a.film.width() != b.film.width() || a.film.height() != b.film.height()) return "its size";
  if (a.samples != b.samples) return "its number of samples";
  if (a.film.layers() != b.film.layers() || a.layers != b.layers) return "its layers";
  if (a.transparent != b.transparent) return "its background";
  if (a.bits != b.bits) return "its bits";
  for (const PictureNote& note : a.notes) {
    const auto same = std::find(b.notes.begin(), b.notes.end(), note);
    if (same != b.notes.end()) continue;
    const auto other = std::find_if(b.notes.begin(), b.notes.end(), [&](const auto& n) { return n.key == note.key; });
    return note.key + " '" + (other == b.notes.end() ? "" : other->text) + "', not '" + note.text + "'";
  }
  return a.notes.size() == b.notes.size() ? "" : "what is said beside it";
}

FilmPart cropped(const FilmPart& part, const PixelWindow& window) {
  FilmPart crop = part;
  crop.film = part.film.cropped(window);
  crop.done.clear();
  for (const SampleBox& box : part.done) {
    const PixelWindow both = overlap(box.window, window);
    if (both.pixels() > 0) crop.done.push_back({both, box.first, box.end});
  }
  crop.done = joined(std::move(crop.done));
  return crop;
}

Result<FilmPart> merge(const std::vector<FilmPart>& parts, const std::vector<std::string>& names) {
  const FilmPart& one = parts.front();
  PixelWindow window = one.film.window();
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const FilmPart& part = parts[i];
    if (const std::string what = picture_difference(one, part); !what.empty()) {
      return input_error("'" + names[i] + "' is of another picture than '" + names[0] + "': " + what);
    }
    window = hull({window, 0, 1}, {part.film.window(), 0, 1}).window;
  }
  if (std::string twice = samples_twice(parts, names); !twice.empty()) return input_error(std::move(twice));

  FilmPart all = one;
  all.film = Film(one.film.width(), one.film.height(), window, one.film.layers());
  all.done.clear();
  for (const FilmPart& part : parts) {
    all.film.add(part.film);
    all.done.insert(all.done.end(), part.done.begin(), part.done.end());
  }
  all.done = joined(std::move(all.done));
  return all;
}

}  // namespace tenon
