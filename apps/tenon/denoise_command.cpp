#include <memory>
#include <string>

#include "commands.h"
#include "picture_arguments.h"
#include "picture_output.h"
#include "scene_arguments.h"
#include "tenon/base/parallel_for.h"

namespace tenon {

namespace {

struct DenoiseCommand {
  std::string path;
  PictureArguments picture;
  bool quiet = false;

  Status run() const;
};

Status DenoiseCommand::run() const {
  const Result<PicturePlan> file = plan_picture(picture, "");
  if (!file) return file.error();
  Console console(quiet);
  console.progress().begin("reading " + path);
  Result<Picture> noisy = read_picture(path);
  if (!noisy) return noisy.error();
  Result<Output> output = Output::open(file->output);
  if (!output) return output.error();
  if (Status status = denoise(*noisy, path, available_threads(), console); !status) return status;
  for (PictureChannel& channel : noisy->channels) {
    const bool is_colour = channel.name == "R" || channel.name == "G" || channel.name == "B" || channel.name == "A";
    if (picture.bits != 0 && is_colour) channel.type = picture.bits == 16 ? ChannelType::half : ChannelType::float32;
  }
  console.progress().begin("writing " + file->output);
  const Result<std::string> bytes = encode(*noisy, *file, false);
  if (!bytes) return bytes.error();
  return output->finish(*bytes);
}

}  // namespace

CommandBody add_denoise_command(CLI::App& command) {
  const auto arguments = std::make_shared<DenoiseCommand>();
  command
      .add_option("PICTURE", arguments->path,
                  "An EXR picture with the layers Z, N, albedo, ids, samples and variance; - reads standard input")
      ->type_name("")
      ->required();
  arguments->picture.add_to(command);
  command.add_flag("-q,--quiet", arguments->quiet, "Show no progress");
  command.footer(
      "The edge-avoiding a-trous wavelet filter (Dammertz and others, 2010), guided by the error that halves of the\n"
      "samples tell of. What it changes beyond that is taken back. Pixels whose ids differ are never mixed. All other\n"
      "channels stay as they are.");
  return [arguments] { return arguments->run(); };
}

}  // namespace tenon
