#include <filesystem>
#include <memory>

#include "commands.h"
#include "scene_arguments.h"
#include "tenon/base/atomic_file.h"
#include "tenon/lang/load.h"

namespace tenon {

namespace {

struct ConvertCommand {
  SceneArguments scene;
  std::string output;

  Status run() const;
};

Status ConvertCommand::run() const {
  const std::string suffix = std::filesystem::path(output).extension().string();
  if (output != "-" && suffix != ".csg") {
    return usage_error("converting to '" + (suffix.empty() ? output : suffix) +
                       "' is not supported yet; there is: .csg (and -o - for the same on standard output)");
  }
  Console console(scene.quiet);
  const Result<Model> model = load(scene, console);
  if (!model) return model.error();
  console.progress().begin("writing " + output);
  const std::string text = print_csg(*model);
  if (output == "-") return write_standard_output(text);
  Result<AtomicFile> file = AtomicFile::create(output);
  if (!file) return file.error();
  if (Status status = file->write(text); !status) return status;
  return file->commit();
}

}  // namespace

CommandBody add_convert_command(CLI::App& command) {
  const auto arguments = std::make_shared<ConvertCommand>();
  arguments->scene.add_to(command);
  command.add_option("-o,--output", arguments->output, "The file to write; its suffix says the format: .csg")
      ->type_name("FILE")
      ->required();
  return [arguments] { return arguments->run(); };
}

}  // namespace tenon
