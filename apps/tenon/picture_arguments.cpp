#include "picture_arguments.h"

#include <algorithm>
#include <filesystem>

#include "commands.h"

namespace tenon {

namespace {

/// What an EXR holds when nobody chose: what compositors expect.
constexpr std::string_view default_layers = "Z,N,P,albedo,ids,samples,variance";

// A device or a pipe has no suffix to go by; it gets what standard output gets.
bool is_device(const std::string& path) {
  std::error_code none;
  const std::filesystem::file_status status = std::filesystem::status(path, none);
  return std::filesystem::exists(status) && !std::filesystem::is_regular_file(status) &&
         !std::filesystem::is_directory(status);
}

Result<PictureFormat> find_format(const PictureArguments& arguments, const std::string& output) {
  if (!arguments.format.empty()) return arguments.format == "png" ? PictureFormat::png : PictureFormat::exr;
  if (const auto format = picture_format(output)) return *format;
  if (output == "-" || is_device(output)) return PictureFormat::png;
  return usage_error("the suffix of '" + output + "' names no picture format; there are: " +
                     std::string(picture_suffixes()) + ", or say --format png or exr");
}

// What goes with one format alone.
Status check_format(const PictureArguments& arguments, const PicturePlan& plan) {
  const bool is_png = plan.format == PictureFormat::png;
  if (plan.bits != 16 && plan.bits != (is_png ? 8 : 32)) {
    return usage_error(is_png ? "--bits is 8 or 16 for a PNG picture" : "--bits is 16 or 32 for an EXR picture");
  }
  if (is_png && !plan.layers.empty()) {
    return usage_error("a PNG picture has no layers; leave --layers out, or write an EXR picture");
  }
  if (!is_png && (arguments.tone_curve != "none" || arguments.exposure != 0)) {
    return usage_error("an EXR picture keeps the light as it is; leave --tonemap and --exposure out, or write a PNG");
  }
  return success();
}

std::string layers_help() {
  std::string text = "What an EXR holds beside R G B A, with commas between them, or all, or none:";
  for (const LayerName& name : layer_names()) text += " " + std::string(name.name) + ": " + std::string(name.doc) + ";";
  text.back() = '.';
  return text + " Otherwise " + std::string(default_layers);
}

}  // namespace

void PictureArguments::add_to(CLI::App& command) {
  command
      .add_option("-o,--output", output, "The picture: a name that ends in .png or .exr; - writes to standard output")
      ->type_name("FILE");
  command.add_option("--format", format, "png or exr, whatever the name ends in; otherwise as it does, and png for -")
      ->type_name("NAME")
      ->check(CLI::IsMember({"png", "exr"}));
  command.add_option("--bits", bits, "Bits of each component: 8 or 16 for PNG (8), 16 or 32 for EXR (16)")
      ->type_name("N");
  command
      .add_option("--tonemap", tone_curve,
                  "How a PNG shows light over 1: none (clamped), reinhard (L/(1+L) on the luminance), filmic "
                  "(Narkowicz's fit of ACES)")
      ->type_name("CURVE")
      ->capture_default_str()
      ->check(CLI::IsMember(std::vector<std::string>(tone_curve_names.begin(), tone_curve_names.end())));
  command.add_option("--exposure", exposure, "Stops by which a PNG shows the light brighter: each doubles it")
      ->type_name("STOPS")
      ->capture_default_str()
      ->check(CLI::Range(-100.0, 100.0).description("-100 to 100"));
}

void PictureArguments::add_layers_to(CLI::App& command) {
  command.add_option("--layers", layers, layers_help())->type_name("NAME,...");
}

void PictureArguments::add_denoise_to(CLI::App& command) {
  command.add_flag(
      "--denoise", denoise,
      "Take the noise out, guided by albedo, normals, depth, ids and what halves of the samples tell of it "
      "(a-trous wavelets); needs 2 samples a pixel at least");
}

Result<PicturePlan> plan_picture(const PictureArguments& arguments, const std::string& default_output) {
  PicturePlan plan;
  plan.output = arguments.output.empty() ? default_output : arguments.output;
  if (plan.output.empty()) return usage_error("say with -o where the picture goes, such as -o picture.png");
  const Result<PictureFormat> format = find_format(arguments, plan.output);
  if (!format) return format.error();
  plan.format = *format;
  const bool is_png = plan.format == PictureFormat::png;
  plan.bits = arguments.bits != 0 ? arguments.bits : is_png ? 8 : 16;
  if (!arguments.layers.empty() || !is_png) {
    const Result<Layers> layers = parse_layers(arguments.layers.empty() ? default_layers : arguments.layers);
    if (!layers) return layers.error();
    plan.layers = *layers;
  }
  const auto curve = std::find(tone_curve_names.begin(), tone_curve_names.end(), arguments.tone_curve);
  plan.tone = {static_cast<ToneCurve>(curve - tone_curve_names.begin()), arguments.exposure};
  plan.denoise = arguments.denoise;
  if (Status status = check_format(arguments, plan); !status) return status.error();
  return plan;
}

}  // namespace tenon
