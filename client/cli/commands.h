#pragma once

#include <vector>

#include "client/cli/command.h"

namespace metamer::cli {

/// Each subcommand, from the file that owns it; commands.def lists them.
namespace commands {
#define METAMER_COMMAND(name) Command name();
#include "client/cli/commands.def"
#undef METAMER_COMMAND
}  // namespace commands

/// All of them, in the order of the help.
std::vector<Command> all_commands();

}  // namespace metamer::cli
