// The man page: each command stands there (tests/deploy/install.sh has groff look at it).

#include "client/cli/man_page.h"

#include <gtest/gtest.h>

#include "client/cli/commands.h"

namespace metamer::cli {

TEST(ManPage, HasEachCommand) {
  const std::string page = man_page();
  for (const Command& command : all_commands())
    EXPECT_NE(page.find(".SS \"metamer " + command.name.substr(0, command.name.find('-'))),
              std::string::npos)
        << command.name;
}

}  // namespace metamer::cli
