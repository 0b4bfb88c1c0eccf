#include "picture_output.h"

#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <iostream>
#include <iterator>
#include <sstream>

#include "commands.h"
#include "tenon/film/denoise.h"
#include "tenon/film/film_picture.h"

namespace tenon {

namespace {

std::string gigabytes(double bytes) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f GB", bytes / 1e9);
  return text;
}

}  // namespace

Status check_memory(double bytes, const std::string& size) {
  const double memory = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  if (bytes <= memory) return success();
  return usage_error("a picture of " + size + " takes " + gigabytes(bytes) + ", and this machine has " +
                     gigabytes(memory) + "; make --size smaller, or take parts of it with --crop");
}

Result<Output> Output::open(const std::string& path) {
  Output output;
  if (path == "-") return output;
  Result<AtomicFile> file = AtomicFile::create(path);
  if (!file) return file.error();
  output.file_.emplace(std::move(*file));
  return output;
}

Status Output::finish(std::string_view bytes) {
  if (!file_) return write_standard_output(bytes);
  if (Status status = file_->write(bytes); !status) return status;
  return file_->commit();
}

Result<std::string> encode(const Picture& picture, const PicturePlan& plan, bool transparent) {
  if (plan.format == PictureFormat::exr) return encode_exr(picture);
  const DisplayPixels shown = display_pixels(picture, plan.tone, transparent);
  const DisplayPicture display{picture.window.width(), picture.window.height(), shown.rgb, shown.alpha};
  return encode_png(display, plan.bits, picture.notes);
}

Result<std::string> encode(const FilmPart& part, const PicturePlan& plan, int threads, Console& console) {
  const bool is_exr = plan.format == PictureFormat::exr;
  Picture picture = is_exr ? part_picture(part) : film_picture(part.film, {}, 32);
  if (!is_exr) {
    picture.notes = part.notes;
    picture.notes.push_back(samples_note(part));
  }
  const auto& samples = part.film.planes().samples;
  const bool tells_noise = std::any_of(samples.begin(), samples.end(), [](std::uint32_t taken) { return taken > 1; });
  if (plan.denoise && !tells_noise) {
    console.diagnostics().warn("no pixel has more than one sample yet, so nothing tells the noise; '" + plan.output +
                               "' keeps it");
  } else if (plan.denoise) {
    // How many samples a pixel has, every film knows.
    if (!part.film.layers().contains(denoise_layers().remove(Layer::samples))) {
      return Error{
          ErrorKind::input, "the pictures lack the layers that denoising goes by; render them with --denoise", {}};
    }
    Picture guided = film_picture(part.film, denoise_layers(), 32);
    if (Status status = denoise(guided, plan.output, threads, console); !status) return status.error();
    // R, G and B come first.
    for (std::size_t c = 0; c < 3; ++c) picture.channels[c].values = std::move(guided.channels[c].values);
  }
  return encode(picture, plan, part.transparent);
}

Status denoise(Picture& picture, const std::string& name, int threads, Console& console) {
  console.progress().begin("denoising");
  ProgressCounters& counters = console.progress().counters();
  counters.total = static_cast<std::uint64_t>(denoise_levels) * static_cast<std::uint64_t>(picture.window.height());
  const Status status = denoise(picture, name, {threads, [&] { ++counters.done; }});
  console.progress().end();
  return status;
}

namespace {

Result<std::string> read_bytes(const std::string& path) {
  std::string bytes;
  if (path == "-") {
    bytes.assign(std::istreambuf_iterator<char>(std::cin), {});
  } else {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    if (file.peek() != std::ifstream::traits_type::eof()) text << file.rdbuf();
    if (!file) {
      return Error{ErrorKind::input, "cannot read '" + path + "': " + std::strerror(errno != 0 ? errno : EINVAL), {}};
    }
    bytes = std::move(text).str();
  }
  return bytes;
}

}  // namespace

Result<Picture> read_picture(const std::string& path) {
  const Result<std::string> bytes = read_bytes(path);
  if (!bytes) return bytes.error();
  return decode_exr(*bytes, path == "-" ? "standard input" : path);
}

Result<Picture> read_head(const std::string& path) {
  const Result<std::string> bytes = read_bytes(path);
  if (!bytes) return bytes.error();
  return decode_head(*bytes, path);
}

}  // namespace tenon
