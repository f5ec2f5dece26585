// The man pages: groff has nothing to say about them, and each option stands there.

#include "server/service/ops/man_page.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "server/service/ops/folders.h"
#include "server/service/ops/options.h"

namespace metamer::service::test {

namespace {

std::string output_of(const std::string& command) {
  FILE* pipe = ::popen(command.c_str(), "r");
  std::string text;
  std::array<char, 4096> piece{};
  while (const std::size_t size = std::fread(piece.data(), 1, piece.size(), pipe))
    text.append(piece.data(), size);
  ::pclose(pipe);
  return text;
}

}  // namespace

TEST(ManPages, GroffShowsEachOptionAndWarnsOfNothing) {
  if (std::system("command -v groff > /dev/null") != 0) GTEST_SKIP() << "there is no groff";
  const TemporaryFolder folder = TemporaryFolder::make().value();
  for (const auto& [name, page] : {std::pair("metamerd.8", metamerd_man_page()),
                                   std::pair("metamerd.toml.5", config_man_page())}) {
    const std::string file = (folder.path() / name).string();
    std::ofstream(file) << page;
    EXPECT_EQ(output_of("groff -man -Tutf8 -ww " + file + " 2>&1 > /dev/null"), "") << name;
    const std::string shown = output_of("groff -man -Tascii -P-cbou " + file);
    for (const Option& option : all_options()) {
      const bool of_file = std::string(name).starts_with("metamerd.toml");
      if (of_file && option.section.empty()) continue;
      EXPECT_NE(shown.find((of_file ? " " : " --") + option.name), std::string::npos)
          << name << " " << option.name;
    }
  }
}

}  // namespace metamer::service::test
