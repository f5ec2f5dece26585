#include <algorithm>
#include <iostream>

#include "client/cli/commands.h"
#include "client/cli/parse.h"
#include "client/cli/report.h"

namespace metamer::cli {
namespace {

int run(const std::string& program, const std::vector<std::string>& words) {
  const std::vector<Command> commands = all_commands();
  const Parsed parsed = parse(commands, program, words);
  // Also where the words make no sense otherwise.
  const bool json = std::find(words.begin(), words.end(), "--json") != words.end();
  if (!parsed.fault.empty() && json) {
    Report report(true);
    report.error(parsed.fault);
    return static_cast<int>(report.finish(ExitCode::bad_input));
  }
  std::cout << parsed.out << std::flush;
  std::cerr << parsed.err;
  if (!parsed.run) return static_cast<int>(parsed.code);
  try {
    return static_cast<int>(parsed.run());
  } catch (const std::exception& error) {
    // Out of memory, most likely: a picture's size is known only when its plan comes.
    std::cerr << "error: " << error.what() << '\n';
    return static_cast<int>(ExitCode::other);
  }
}

}  // namespace
}  // namespace metamer::cli

int main(int argc, char** argv) {
  return metamer::cli::run(argc > 0 ? argv[0] : "metamer", {argv + std::min(argc, 1), argv + argc});
}
