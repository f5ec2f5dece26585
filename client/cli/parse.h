#pragma once

#include <functional>
#include <string>
#include <vector>

#include "client/cli/command.h"

namespace metamer::cli {

/// What the words of a command line come to.
struct Parsed {
  std::function<ExitCode()> run;   ///< The subcommand that was named; none: say what follows.
  ExitCode code = ExitCode::done;  ///< bad_input: the words make no sense.
  std::string out, err;            ///< For stdout and stderr: a help text, say.
  std::string fault;               ///< What makes no sense, without advice; empty: nothing.
};

/// Reads the words (argv without the program's own name) into the targets of the options of the
/// subcommand that they name; --help and --version give texts. A flag that is given to a
/// subcommand counts for the one below it too, where that has it. `commands` must outlive `run`.
Parsed parse(const std::vector<Command>& commands, const std::string& program,
             const std::vector<std::string>& words);

}  // namespace metamer::cli
