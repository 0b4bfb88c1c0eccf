#include "checkpoint.h"

#include <algorithm>
#include <filesystem>

#include "picture_output.h"
#include "tenon/base/atomic_file.h"

namespace tenon {

namespace {

Status write_part(const std::string& path, const FilmPart& part) {
  const Result<std::string> bytes = encode_exr(part_picture(part));
  if (!bytes) return bytes.error();
  Result<AtomicFile> file = AtomicFile::create(path);
  if (!file) return file.error();
  if (Status status = file->write(*bytes); !status) return status;
  return file->commit();
}

}  // namespace

Status Checkpoint::check() const {
  const Result<AtomicFile> file = AtomicFile::create(path_);
  if (!file) return file.error();
  return success();
}

Result<std::optional<Film>> Checkpoint::load(const RenderOptions& options) const {
  if (!std::filesystem::exists(path_)) return std::optional<Film>();
  const Result<Picture> picture = read_picture(path_);
  if (!picture) return picture.error();
  Result<FilmPart> kept = read_part(*picture, path_);
  if (!kept) return kept.error();
  std::string difference;
  if (kept->film.window() != film_window(options) || kept->film.layers() != film_layers(options)) {
    difference = "its part of the picture or its layers";
  } else if (std::any_of(kept->done.begin(), kept->done.end(), [&](const SampleBox& box) {
               return box.first != options.first_sample || box.end > options.end_sample.value_or(options.samples);
             })) {
    difference = "its samples";
  } else {
    FilmPart expected = part_;
    expected.film = Film(options.width, options.height, {0, 0, 1, 1}, film_layers(options));
    difference = picture_difference(expected, *kept);
  }
  if (difference.empty()) return std::optional<Film>(std::move(kept->film));
  return Error{
      ErrorKind::input,
      "'" + path_ + "' is the checkpoint of another picture: " + difference + "; render that one, or remove the file",
      {}};
}

void Checkpoint::save(const Film& film, const std::vector<SampleBox>& done, Console& console) {
  part_.film = film;
  part_.done = done;
  const Status status = write_part(path_, part_);
  part_.film = {};
  const std::string problem = status ? "" : status.error().message;
  if (problem != problem_) {
    if (status) {
      console.progress().say("tenon: '" + path_ + "' can be written again");
    } else {
      console.diagnostics().warn(problem + "; the work goes on without checkpoints until this is mended");
    }
  }
  problem_ = problem;
}

void Checkpoint::remove() const {
  std::error_code ignored;
  std::filesystem::remove(path_, ignored);
}

}  // namespace tenon
