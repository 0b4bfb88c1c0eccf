#pragma once

#include <CLI/CLI.hpp>
#include <functional>

#include "tenon/base/error.h"

namespace tenon {

/// What a subcommand does once its arguments are read.
using CommandBody = std::function<Status()>;

CommandBody add_render_command(CLI::App& command);
CommandBody add_merge_command(CLI::App& command);
CommandBody add_denoise_command(CLI::App& command);
CommandBody add_trace_command(CLI::App& command);
CommandBody add_info_command(CLI::App& command);
CommandBody add_compare_command(CLI::App& command);
CommandBody add_convert_command(CLI::App& command);
CommandBody add_lab_command(CLI::App& command);

inline Error usage_error(std::string message) {
  return {ErrorKind::usage, std::move(message), {}};
}

}  // namespace tenon
