#include "work_arguments.h"

#include <charconv>
#include <string_view>
#include <vector>

#include "commands.h"

namespace tenon {

namespace {

// What a pixel gets at most when a noise target or the clock is to end the work.
constexpr std::uint32_t open_ended_samples = 65536;
// Smooth edges, and still at once.
constexpr std::uint32_t usual_samples = 4;

std::optional<std::vector<int>> parse_integers(std::string_view text, char separator) {
  std::vector<int> numbers;
  for (;;) {
    const std::size_t end = std::min(text.find(separator), text.size());
    int number = 0;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + end, number);
    if (error != std::errc() || rest != text.data() + end) return std::nullopt;
    numbers.push_back(number);
    if (end == text.size()) return numbers;
    text.remove_prefix(end + 1);
  }
}

Status read_crop(const std::string& text, RenderOptions& options) {
  const auto n = parse_integers(text, ',');
  const auto wrong = [&](const std::string& why) {
    return usage_error("--crop takes x0,y0,x1,y1 in pixels from the upper left corner, up to x1 and y1 without them" +
                       why + ", not '" + text + "'");
  };
  if (!n || n->size() != 4) return wrong(", such as 100,50,300,200");
  const PixelWindow crop{(*n)[0], (*n)[1], (*n)[2], (*n)[3]};
  if (crop.x0 < 0 || crop.y0 < 0 || crop.x1 > options.width || crop.y1 > options.height || crop.x0 >= crop.x1 ||
      crop.y0 >= crop.y1) {
    return wrong(", within " + std::to_string(options.width) + "x" + std::to_string(options.height));
  }
  options.crop = crop;
  return success();
}

Status read_samples(const std::string& text, RenderOptions& options) {
  const auto n = parse_integers(text, ':');
  if (!n || n->size() != 2 || (*n)[0] < 0 || (*n)[0] >= (*n)[1] ||
      static_cast<std::uint32_t>((*n)[1]) > options.samples) {
    return usage_error("--samples takes a:b, from sample a up to b without it, of the " +
                       std::to_string(options.samples) + " that --spp asks for, such as 0:" +
                       std::to_string(std::max(1U, options.samples / 2)) + ", not '" + text + "'");
  }
  options.first_sample = static_cast<std::uint32_t>((*n)[0]);
  options.end_sample = static_cast<std::uint32_t>((*n)[1]);
  return success();
}

}  // namespace

void WorkArguments::add_to(CLI::App& command) {
  command
      .add_option("--spp", samples_per_pixel,
                  "Samples for each pixel; 1: its centre. Otherwise 4; with --noise or --time at most 65536")
      ->type_name("N")
      ->check(CLI::Range(1U, most_samples).description("1 to " + std::to_string(most_samples)));
  command
      .add_option("--noise", noise,
                  "Take no more samples of a tile of 16 x 16 pixels, but at least 16, once its noise is no more than "
                  "this: (eR + eG + eB) / sqrt(R + G + B) on average, e being errors (Dammertz 2009), where single "
                  "pixels that err far more count by their squares; 0.02 is hardly seen")
      ->type_name("TARGET")
      ->check(CLI::Range(1e-9, 1e9).description("over 0"));
  command
      .add_option("--time", seconds,
                  "Take no more samples after so many seconds of rendering, but one of each pixel at least")
      ->type_name("SECONDS")
      ->check(CLI::Range(1e-3, 1e9).description("over 0"));
  command
      .add_option("--crop", crop,
                  "Take only this part of the picture, in pixels: an EXR says where it belongs (data window), a PNG is "
                  "as large as the part")
      ->type_name("X0,Y0,X1,Y1");
  command.add_option("--samples", samples, "Take only the samples from a up to b, b left out, for 'tenon merge'")
      ->type_name("A:B");
  command
      .add_option(
          "--checkpoint", checkpoint,
          "Keep what is done in this file now and then, an EXR with exact sums; it goes when the picture is done, and "
          "one that is there is not written over without --resume")
      ->type_name("FILE");
  command.add_option("--checkpoint-every", checkpoint_seconds, "Seconds of work between two checkpoints")
      ->type_name("SECONDS")
      ->capture_default_str()
      ->check(CLI::Range(0.01, 1e9).description("over 0.01"));
  command
      .add_option(
          "--animate", frames,
          "Take so many pictures, with $t = 0, 1/N, ... up to 1 without it: x.png is x00000.png, x00001.png ...")
      ->type_name("N")
      ->check(CLI::Range(1, 99999).description("1 to 99999"));
  command.add_flag(
      "--resume", resume,
      "Go on from the file of --checkpoint, where there is one, to the same bytes as without a break; with "
      "--animate, leave frames alone that are there, whole and of the same scene and arguments");
}

Status plan_work(const WorkArguments& arguments, RenderOptions& options) {
  const bool open_ended = arguments.noise > 0 || arguments.seconds > 0;
  options.samples = arguments.samples_per_pixel != 0 ? arguments.samples_per_pixel
                    : open_ended                     ? open_ended_samples
                                                     : usual_samples;
  options.noise = arguments.noise;
  options.seconds = arguments.seconds;
  if (!arguments.crop.empty()) {
    if (Status status = read_crop(arguments.crop, options); !status) return status;
  }
  if (!arguments.samples.empty()) {
    if (arguments.noise > 0) {
      return usage_error("--noise needs all samples of a pixel to decide; use --crop in place of --samples");
    }
    if (Status status = read_samples(arguments.samples, options); !status) return status;
  }
  if (arguments.resume && arguments.checkpoint.empty() && arguments.frames == 0) {
    return usage_error("--resume goes on from a checkpoint; name its file with --checkpoint, or use --animate");
  }
  return success();
}

}  // namespace tenon
