#include <array>
#include <filesystem>
#include <limits>
#include <memory>
#include <string_view>

#include "commands.h"
#include "scene_arguments.h"
#include "tenon/base/atomic_file.h"
#include "tenon/exchange/pov.h"
#include "tenon/lang/load.h"
#include "tenon/render/renderer.h"

namespace tenon {

namespace {

struct ConvertCommand {
  SceneArguments scene;
  std::string output;

  Status run() const;
};

Result<std::string> write_csg(Model&& model, Console&) {
  return print_csg(model);
}

Result<std::string> write_pov(Model&& model, Console& console) {
  constexpr double spell_out_all = std::numeric_limits<double>::infinity();
  const Result<Scene> scene = compile_scene(std::move(model), console.diagnostics(), {}, spell_out_all);
  if (!scene) return scene.error();
  return print_pov(*scene, RenderOptions{}.depth);
}

// The whole scene as text.
struct Format {
  std::string_view suffix;
  Result<std::string> (*write)(Model&& model, Console& console);
};

constexpr std::array<Format, 2> formats{{{".csg", write_csg}, {".pov", write_pov}}};

// Standard output has no suffix; it gets what Tenon itself reads.
Result<const Format*> find_format(const std::string& output) {
  const std::string suffix = output == "-" ? ".csg" : std::filesystem::path(output).extension().string();
  std::string there_is;
  for (const Format& format : formats) {
    if (format.suffix == suffix) return &format;
    there_is += (there_is.empty() ? "" : ", ") + std::string(format.suffix);
  }
  return usage_error("converting to '" + (suffix.empty() ? output : suffix) +
                     "' is not supported yet; there is: " + there_is + " (and -o - for .csg on standard output)");
}

Status ConvertCommand::run() const {
  const Result<const Format*> format = find_format(output);
  if (!format) return format.error();
  Console console(scene.quiet);
  Result<Model> model = load(scene, console);
  if (!model) return model.error();
  console.progress().begin("writing " + output);
  const Result<std::string> text = (*format)->write(std::move(*model), console);
  if (!text) return text.error();
  if (output == "-") return write_standard_output(*text);
  Result<AtomicFile> file = AtomicFile::create(output);
  if (!file) return file.error();
  if (Status status = file->write(*text); !status) return status;
  return file->commit();
}

}  // namespace

CommandBody add_convert_command(CLI::App& command) {
  const auto arguments = std::make_shared<ConvertCommand>();
  arguments->scene.add_to(command);
  command.add_option("-o,--output", arguments->output, "The file to write; its suffix says the format: .csg, .pov")
      ->type_name("FILE")
      ->required();
  return [arguments] { return arguments->run(); };
}

}  // namespace tenon
