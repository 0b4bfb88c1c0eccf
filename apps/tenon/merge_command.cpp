#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "commands.h"
#include "picture_arguments.h"
#include "picture_output.h"
#include "scene_arguments.h"
#include "tenon/base/parallel_for.h"
#include "tenon/film/film_part.h"

namespace tenon {

namespace {

struct MergeCommand {
  std::vector<std::string> paths;
  PictureArguments picture;
  bool quiet = false;

  Status run() const;
};

Status MergeCommand::run() const {
  const Result<PicturePlan> file = plan_picture(picture, "");
  if (!file) return file.error();
  Console console(quiet);
  console.progress().begin("reading pictures");
  console.progress().counters().total = paths.size();
  std::vector<FilmPart> parts;
  for (const std::string& path : paths) {
    const Result<Picture> read = read_picture(path);
    if (!read) return read.error();
    Result<FilmPart> part = read_part(*read, path);
    if (!part) return part.error();
    parts.push_back(std::move(*part));
    ++console.progress().counters().done;
  }
  Result<Output> output = Output::open(file->output);
  if (!output) return output.error();
  console.progress().begin("merging " + std::to_string(paths.size()) + " pictures");
  Result<FilmPart> merged = merge(parts, paths);
  if (!merged) return merged.error();
  if (picture.bits != 0 && file->format == PictureFormat::exr) merged->bits = picture.bits;
  const Result<std::string> bytes = encode(*merged, *file, available_threads(), console);
  if (!bytes) return bytes.error();
  if (Status status = output->finish(*bytes); !status) return status;
  console.progress().end();
  if (!merged->is_complete() && !quiet) {
    char text[64];
    std::snprintf(text, sizeof text, ": %.1f %% of the picture's samples; more may be merged with it",
                  100 * merged->share());
    console.progress().say("tenon: " + file->output + text);
  }
  return success();
}

}  // namespace

CommandBody add_merge_command(CLI::App& command) {
  const auto arguments = std::make_shared<MergeCommand>();
  command.add_option("PICTURES", arguments->paths, "EXR pictures made with --samples, --crop or --layers sums")
      ->type_name("")
      ->required();
  arguments->picture.add_to(command);
  arguments->picture.add_denoise_to(command);
  command.add_flag("-q,--quiet", arguments->quiet, "Show no progress");
  command.footer(
      "Adds up parts of one picture, in any order, to the same bytes as when it is taken in one go:\n"
      "  tenon render s.scad --spp 64 --samples 0:32 -o a.exr    on one machine\n"
      "  tenon render s.scad --spp 64 --samples 32:64 -o b.exr   on another\n"
      "  tenon merge a.exr b.exr -o s.png");
  return [arguments] { return arguments->run(); };
}

}  // namespace tenon
