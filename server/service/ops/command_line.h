#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "server/service/ops/config_file.h"
#include "server/service/ops/options.h"

namespace metamer::service {

/// The program's exit codes.
inline constexpr int exit_ok = 0;
inline constexpr int exit_failure = 1;
inline constexpr int exit_usage = 2;  ///< A wrong command line or configuration.

/// What the program was called with.
struct CommandLine {
  enum class Task { serve, print_config, check_config };
  Task task = Task::serve;
  std::optional<std::string> config;  ///< The file to read first.
  bool config_is_default = false;     ///< It may be missing then.
  std::vector<std::pair<const Option*, std::vector<std::string>>> words;
};

/// Reads it. Where it asks for help or is wrong, that is said on stdout or stderr, and the value is
/// the exit code.
tl::expected<CommandLine, int> parse_command_line(int argc, const char* const* argv);

/// What the file and then the command line say.
tl::expected<Settings, Problems> settings_of(const CommandLine& line);

}  // namespace metamer::service
