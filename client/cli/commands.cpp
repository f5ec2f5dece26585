#include "client/cli/commands.h"

namespace metamer::cli {

std::vector<Command> all_commands() {
  std::vector<Command> all;
#define METAMER_COMMAND(name) all.push_back(commands::name());
#include "client/cli/commands.def"
#undef METAMER_COMMAND
  return all;
}

}  // namespace metamer::cli
