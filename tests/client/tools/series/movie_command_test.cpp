// The command for a movie names the frames of a series, in their order, and no others.
#include "client/tools/series/movie_command.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdio>

namespace metamer::client {
namespace {

std::string movie_of(const std::string& pattern, const std::string& frames, bool even = true) {
  return movie_command(FrameName::parse(pattern).value(), parse_frames(frames).value(), even);
}

/// What a shell says.
std::string shell_says(const std::string& line) {
  std::string text;
  FILE* pipe = popen(line.c_str(), "r");
  std::array<char, 256> part{};
  while (pipe != nullptr && std::fgets(part.data(), part.size(), pipe) != nullptr)
    text += part.data();
  if (pipe != nullptr) pclose(pipe);
  return text;
}

TEST(MovieCommand, OfConsecutiveFramesEndsWithTheLast) {
  EXPECT_EQ(movie_of("it's/%04d.png", "340:380"),
            "ffmpeg -framerate 24 -start_number 340 -i 'it'\\''s/%04d.png' -frames:v 41 -pix_fmt "
            "yuv420p turntable.mp4");
  EXPECT_NE(movie_of("%d.png", "0:1", false).find(" -vf 'pad="), std::string::npos);
}

TEST(MovieCommand, OtherFramesAreNamedOneByOneInTheirOrder) {
  // 10 comes before 8 in a directory; %4d of ffmpeg is filled up with zeros.
  for (const char* pattern : {"e/%d.png", "it's %%/\\n-%4d.png", "-%03d.png"}) {
    std::string line = movie_of(pattern, "8:12:2"), expected;
    const auto name = FrameName::parse(pattern).value();
    for (const std::uint32_t frame : {8u, 10u, 12u}) expected += name.of(frame) + "\n";
    line.replace(line.find("cat -- "), 7, "printf '%s\\n' ");
    EXPECT_EQ(shell_says(line.substr(0, line.find(" | ffmpeg"))), expected) << line;
  }
  EXPECT_EQ(movie_of("%4d.png", "0:9").find("-start_number"), std::string::npos);
  EXPECT_EQ(movie_of("a%%*%d.png", "0:9").find("-start_number"), std::string::npos);
}

}  // namespace
}  // namespace metamer::client
