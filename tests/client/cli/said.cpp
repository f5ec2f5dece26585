#include "tests/client/cli/said.h"

#include <gtest/gtest.h>

#include "client/cli/commands.h"
#include "client/cli/parse.h"

namespace metamer::cli {

Said say(const std::vector<std::string>& words) {
  const std::vector<Command> commands = all_commands();
  const Parsed parsed = parse(commands, "metamer", words);
  if (!parsed.run) return {parsed.code, parsed.out, parsed.err};
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const ExitCode code = parsed.run();
  return {code, testing::internal::GetCapturedStdout(), testing::internal::GetCapturedStderr()};
}

}  // namespace metamer::cli
