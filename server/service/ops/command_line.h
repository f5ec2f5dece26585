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

/// What keeps settings from being carried out that are right one by one: an endpoint by TLS without
/// a certificate, certificates that this process can't read, a way in that is open to other
/// machines, a group that does not exist. Reads the certificates; opens no socket. A host's name is
/// not looked up, so that one which leads beyond this machine is found when it is listened on.
Problems contradictions(const Settings& settings);

/// What can be carried out and is hardly meant: a key that others than its owner may read, a disk
/// of the state that is smaller than what may come to lie there.
std::vector<std::string> cautions(const Settings& settings);

}  // namespace metamer::service
