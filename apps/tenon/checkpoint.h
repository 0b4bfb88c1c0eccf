#pragma once

#include <optional>
#include <string>

#include "scene_arguments.h"
#include "tenon/film/film_part.h"
#include "tenon/render/renderer.h"

namespace tenon {

/// The file of `--checkpoint`.
class Checkpoint {
 public:
  /// @param path   of the file
  /// @param empty  the part that the work is to fill: all but its film
  Checkpoint(std::string path, FilmPart empty) : path_(std::move(path)), part_(std::move(empty)) {}

  /// A machine error when the file cannot be written.
  Status check() const;
  /// What is in the file, to go on from; nothing where there is no file yet.
  /// @return the film, or an input error: a checkpoint of another picture
  Result<std::optional<Film>> load(const RenderOptions& options) const;
  /// Replaces the file. Where it cannot, the work goes on, and the checkpoint before stays; that is said once, and
  /// again only when something else is wrong, or nothing any more.
  void save(const Film& film, const std::vector<SampleBox>& done, Console& console);
  /// The work is done.
  void remove() const;

 private:
  std::string path_;
  FilmPart part_;
  std::string problem_;  // why it could not be written last time
};

}  // namespace tenon
