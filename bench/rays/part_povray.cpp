#include <cstdio>
#include <fstream>
#include <iterator>

#include "rays/bench_scene.h"
#include "rays/parts.h"
#include "tenon/accel/accelerator.h"
#include "tenon/base/atomic_file.h"
#include "tenon/exchange/pov.h"
#include "tenon/film/film_picture.h"
#include "tenon/image/picture_file.h"
#include "tenon/math/color.h"
#include "tenon/render/renderer.h"

namespace tenon::bench {

namespace {

std::string read_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

Status save_picture(std::span<const float> rgb, const std::string& path) {
  const Result<std::string> png = encode_png({picture_width, picture_height, rgb, {}}, 8, {});
  if (!png) return png.error();
  Result<AtomicFile> file = AtomicFile::create(path);
  if (!file) return file.error();
  if (Status status = file->write(*png); !status) return status;
  return file->commit();
}

// CPU seconds of a picture, taken over and over for as long as POV-Ray's shortest: one of ours is done before the
// machine has come back to its pace after the other program.
template <class Take>
double seconds_of_one(const Take& take) {
  constexpr double least_seconds = 0.3;
  int pictures = 0;
  const double seconds = cpu_seconds([&] {
    const double begun = thread_cpu_seconds();
    do {
      take();
      ++pictures;
    } while (thread_cpu_seconds() - begun < least_seconds);
  });
  return seconds / pictures;
}

// CPU seconds that POV-Ray says tracing took; parsing and its bounding hierarchy it counts apart.
Result<double> povray_seconds(const std::string& base) {
  const std::string line = "povray +I" + base + ".pov +O" + base + ".ppm +FP16 File_Gamma=1 +W" +
                           std::to_string(picture_width) + " +H" + std::to_string(picture_height) + " -D -A +WT1 >" +
                           base + ".log 2>&1";
  if (std::system(line.c_str()) != 0) return Error{ErrorKind::machine, "POV-Ray failed; see " + base + ".log", {}};
  const std::string log = read_file(base + ".log");
  const std::size_t trace = log.find("Trace Time:"), with = log.find(" with ", trace);
  double seconds = 0;
  if (trace == std::string::npos || with == std::string::npos ||
      std::sscanf(log.c_str() + with, " with %lf CPU-seconds", &seconds) != 1) {
    return Error{ErrorKind::machine, "POV-Ray did not say how long it took; see " + base + ".log", {}};
  }
  return seconds;
}

// The picture that POV-Ray left: 16 bits of linear light at the end of the file.
std::vector<float> povray_picture(const std::string& base) {
  const std::string bytes = read_file(base + ".ppm");
  constexpr std::size_t size = std::size_t{3} * picture_width * picture_height;
  std::vector<float> rgb;
  if (bytes.size() < 2 * size) return std::vector<float>(size);
  for (std::size_t i = bytes.size() - 2 * size; i < bytes.size(); i += 2) {
    const int high = static_cast<unsigned char>(bytes[i]), low = static_cast<unsigned char>(bytes[i + 1]);
    rgb.push_back(static_cast<float>(256 * high + low) / 65535.0F);
  }
  return rgb;
}

// Pixels that differ by more than eight steps of 255 in some component.
std::size_t different_pixels(std::span<const float> a, std::span<const float> b) {
  const auto step = [](float v) { return 255 * srgb_from_linear(static_cast<double>(v)); };
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.size(); i += 3) {
    bool differs = false;
    for (std::size_t k = i; k < i + 3; ++k) differs |= std::fabs(step(a[k]) - step(b[k])) > 8;
    count += differs;
  }
  return count;
}

}  // namespace

Status run_povray(const PartOptions& options, Report& report) {
  report.note(
      "POV-Ray's CPU seconds of tracing with +WT1, shading included, parsing not; Tenon's of render(), likewise");
  std::vector<double> ratios;
  for (const std::string& name : options.scenes) {
    const Result<BenchScene> scene = read_scene(scene_path(name));
    if (!scene) return scene.error();
    const ScreenView& view = scene->camera.view();
    const Result<std::unique_ptr<Accelerator>> accelerator =
        build_accelerator(options.accelerator, *scene->scene.tree, &view);
    if (!accelerator) return accelerator.error();
    RenderOptions render_options;
    render_options.threads = 1;
    const Result<std::string> pov = print_pov(scene->scene, render_options.depth);
    if (!pov) return pov.error();
    const std::string base = results_folder() + "/" + name;
    std::ofstream(base + ".pov") << *pov;

    Timing own{"tenon " + options.accelerator, {}}, theirs{"povray", {}};
    Film film;
    std::size_t rays = 0;
    for (int i = 0; i < rounds; ++i) {
      own.seconds.push_back(seconds_of_one([&] {
        Result<Rendering> rendering = render(scene->scene, **accelerator, render_options);
        if (!rendering) return;
        film = std::move(rendering->film);
        rays = rendering->statistics.total().rays;
      }));
      const Result<double> seconds = povray_seconds(base);
      if (!seconds) return seconds.error();
      theirs.seconds.push_back(*seconds);
    }
    report.rate(name, "picture", own, rays);
    report.rate(name, "picture", theirs, rays, &own);
    ratios.push_back(ratio(theirs, own));
    const std::vector<float> picture = povray_picture(base);
    const std::vector<float> drawn = display_pixels(film_picture(film, {}, 32), {}, false).rgb;
    report.figure(name, "pixels that differ", static_cast<double>(different_pixels(drawn, picture)), "");
    if (Status status = save_picture(drawn, base + "_picture_tenon.png"); !status) return status;
    if (Status status = save_picture(picture, base + "_picture_povray.png"); !status) return status;
  }
  report.summary("tenon against POV-Ray, shading included", ratios);
  return success();
}

}  // namespace tenon::bench
