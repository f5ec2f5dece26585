#include "server/service/executors/slurm/command.h"

#include <gtest/gtest.h>
#include <stdlib.h>

#include <chrono>

#include "server/service/executors/slurm/commands.h"

namespace metamer::service {
namespace {

using std::chrono::milliseconds;

const std::atomic<bool> wanted = false;

std::string error_of(const std::vector<std::string>& words, const CommandLimits& limits = {},
                     const std::atomic<bool>& cancelled = wanted) {
  const auto said = run_command(words, {}, limits, cancelled);
  return said ? "none: " + *said : said.error().message;
}

TEST(SlurmCommand, GivesItsInputAndWhatItSays) {
  EXPECT_EQ(run_command({"cat"}, "some words", {}, wanted).value(), "some words");
}

TEST(SlurmCommand, HasNothingOfTheEnvironmentButWhatFindsSlurm) {
  ASSERT_EQ(::setenv("SECRET_OF_THE_DAEMON", "x", 1), 0);
  ASSERT_EQ(::setenv("SLURM_CONF", "/somewhere", 1), 0);
  const std::string environment = run_command({"env"}, {}, {}, wanted).value();
  ::unsetenv("SECRET_OF_THE_DAEMON");
  ::unsetenv("SLURM_CONF");
  EXPECT_EQ(environment.find("SECRET"), environment.npos);
  EXPECT_NE(environment.find("SLURM_CONF=/somewhere"), environment.npos);
}

TEST(SlurmCommand, ThatGoesWrongSaysHow) {
  EXPECT_EQ(error_of({"no-such-program-of-slurm"}),
            "can't start no-such-program-of-slurm: No such file or directory");
  EXPECT_EQ(error_of({"sh", "-c", "echo of no use >&2; echo more >&2; exit 3"}),
            "sh says: of no use");
  EXPECT_EQ(error_of({"sh", "-c", "kill -9 $$"}), "sh killed by signal 9 (Killed)");
}

TEST(SlurmCommand, ThatTakesTooLongOrSaysTooMuchIsEnded) {
  EXPECT_EQ(error_of({"sleep", "60"}, {.time = milliseconds(50)}),
            "sleep did not end within 50 ms");
  EXPECT_EQ(error_of({"yes"}, {.bytes = 1000}), "yes said too much");
  const std::atomic<bool> cancelled = true;
  EXPECT_EQ(error_of({"sleep", "60"}, {}, cancelled), "sleep was ended with the server");
}

TEST(SlurmCommand, ScriptNamesItsFilesWhateverTheyAreCalled) {
  const SlurmCommands::Options options{
      .worker = "/opt/it's here/metamer-worker", .threads = 3, .arguments = {}};
  EXPECT_EQ(batch_script(options, "/shared/a b"),
            "#!/bin/sh\nexec '/opt/it'\\''s here/metamer-worker' --batch '/shared/a "
            "b/'\"$SLURM_ARRAY_TASK_ID\".order --threads 3\n");
}

}  // namespace
}  // namespace metamer::service
