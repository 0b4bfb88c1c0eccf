#include <array>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <new>
#include <string>
#include <vector>

#include "commands.h"
#include "tenon/base/atomic_file.h"
#include "tenon/base/interrupt.h"
#include "tenon/base/suggestion.h"
#include "tenon/version.h"

namespace {

using namespace tenon;

struct Command {
  const char* name;
  const char* summary;
  CommandBody (*add)(CLI::App& command);
};

constexpr std::array<Command, 8> commands{{
    {"render", "Take a picture of a scene", add_render_command},
    {"merge", "Add up parts of one picture, made on any machines in any order", add_merge_command},
    {"denoise", "Take the noise out of an EXR picture", add_denoise_command},
    {"trace", "Follow rays through a scene; one JSON object a line", add_trace_command},
    {"compare", "Trace the same rays through every structure, and check the answers", add_compare_command},
    {"info", "Say what a scene holds", add_info_command},
    {"convert", "Write the evaluated scene to another format", add_convert_command},
    {"lab", "Measure the papers' tables again, beside the papers' figures", add_lab_command},
}};

constexpr const char* exit_statuses =
    "Exit status: 0 done, 1 the scene or an input is wrong, 2 wrong usage, 3 the machine failed (disk full, out of "
    "memory), 130 interrupted (what is there of a picture is kept).";

int report(const Error& error) {
  std::fprintf(stderr, "%s\n", format_error(error).c_str());
  return static_cast<int>(error.kind);
}

// What to say of the first word that looks like an option and is none.
std::string unknown_option(const CLI::App& command) {
  for (const std::string& word : command.remaining(true)) {
    if (!word.starts_with("-") || word.size() < 2) continue;
    const std::string name = word.substr(0, word.find('='));
    std::vector<std::string> known;
    for (const CLI::Option* option : command.get_options()) {
      for (const std::string& long_name : option->get_lnames()) known.push_back("--" + long_name);
    }
    return "there is no option '" + name + "'" + suggestion(name, {known.begin(), known.end()});
  }
  return "";
}

// What CLI11 says, as our messages begin, and with the way on.
int report_usage(const CLI::App& app, const CLI::ParseError& error) {
  std::string name = "tenon";
  const CLI::App* command = &app;
  for (const CLI::App* chosen : app.get_subcommands()) command = chosen;
  if (command != &app) name += ' ' + command->get_name();
  std::string message = error.what();
  if (const std::string option = unknown_option(*command); !option.empty()) message = option;
  // A sentence's capital goes; a name in capitals stays.
  if (message.size() > 1 && std::isupper(static_cast<unsigned char>(message[1])) == 0) {
    message[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(message[0])));
  }
  return report({ErrorKind::usage, message + "; see '" + name + " --help'", {}});
}

// A first word that is no command, such as the name of a scene.
bool is_unknown_command(const char* word) {
  if (word[0] == '-') return false;
  for (const Command& command : commands) {
    if (std::string_view(command.name) == word) return false;
  }
  return true;
}

int run(int argc, char** argv) {
  CLI::App app("Tenon ray traces constructive solid geometry exactly.", "tenon");
  const std::string version_text = "tenon " + std::string(version());
  app.set_version_flag("--version", version_text);
  app.require_subcommand(0, 1);
  app.footer(exit_statuses);

  std::array<CommandBody, commands.size()> bodies;
  std::array<CLI::App*, commands.size()> parsers{};
  std::string names;
  for (std::size_t i = 0; i < commands.size(); ++i) {
    parsers[i] = app.add_subcommand(commands[i].name, commands[i].summary);
    parsers[i]->set_version_flag("--version", version_text);
    bodies[i] = commands[i].add(*parsers[i]);
    names += (i == 0 ? "" : ", ") + std::string(commands[i].name);
  }

  if (argc < 2) return report({ErrorKind::usage, "say what to do: " + names + "; see 'tenon --help'", {}});
  if (is_unknown_command(argv[1])) {
    const std::string word = argv[1];
    std::error_code none;
    if (std::filesystem::is_regular_file(word, none)) {
      return report(
          {ErrorKind::usage, "there is no command '" + word + "'; for a picture of it: tenon render " + word, {}});
    }
    std::vector<std::string_view> known;
    for (const Command& command : commands) known.emplace_back(command.name);
    return report({ErrorKind::usage,
                   "there is no command '" + word + "'" + suggestion(word, known) + "; there are: " + names,
                   {}});
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& wanted) {
    return app.exit(wanted);
  } catch (const CLI::ParseError& error) {
    return report_usage(app, error);
  }
  for (std::size_t i = 0; i < commands.size(); ++i) {
    if (!parsers[i]->parsed()) continue;
    if (const Status status = bodies[i](); !status) return report(status.error());
    if (const int signal = noted_interrupt(); signal != 0) return 128 + signal;
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  remove_temporary_files_on_signals();
  try {
    return run(argc, argv);
  } catch (const std::bad_alloc&) {
    std::fputs("tenon: error: out of memory; make the scene or the picture smaller\n", stderr);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "tenon: error: %s\n", error.what());
  }
  return static_cast<int>(ErrorKind::machine);
}
