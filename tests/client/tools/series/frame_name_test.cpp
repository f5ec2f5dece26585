// Which frames, and how their files are called.
#include "client/tools/series/frame_name.h"

#include <gtest/gtest.h>

#include <cstdio>

namespace metamer::client {
namespace {

TEST(FrameName, IsWhatPrintfMakesOfThePattern) {
  for (const char* pattern : {"a-%d.png", "%04d.png", "f%9d.exr", "%09d", "%1d-", "x%05d%%.png"}) {
    const auto name = FrameName::parse(pattern);
    ASSERT_TRUE(name) << name.error().message;
    for (const unsigned number : {0u, 7u, 359u, 12345u, 4294967295u}) {
      char text[64];
      std::snprintf(text, sizeof text, pattern, static_cast<int>(number & 0x7fffffff));
      EXPECT_EQ(name->of(number & 0x7fffffff), text) << pattern;
    }
  }
  EXPECT_EQ(FrameName::parse("100%%/%d.png")->of(3), "100%/3.png");
}

TEST(FrameName, WithoutOnePlaceForANumberIsNone) {
  for (const char* pattern : {"a.png", "", "100%%.png", "%d-%d.png", "%s.png", "%", "%0", "%04",
                              "%10d.png", "%-4d.png", "%n.png", "%ld.png", "%d%"})
    EXPECT_FALSE(FrameName::parse(pattern)) << pattern;
}

TEST(Frames, GoFromTheFirstToTheLast) {
  using Frames = std::vector<std::uint32_t>;
  EXPECT_EQ(parse_frames("0:3").value(), (Frames{0, 1, 2, 3}));
  EXPECT_EQ(parse_frames("10:35:10").value(), (Frames{10, 20, 30}));
  EXPECT_EQ(parse_frames("7").value(), Frames{7});
  EXPECT_EQ(parse_frames("4294967290:4294967295:4").value(), (Frames{4294967290u, 4294967294u}));
  EXPECT_EQ(parse_frames("0:99999")->size(), 100'000u);
  for (const char* wrong : {"", ":", "a", "0:", ":3", "3:2", "0:9:0", "0:9:1:1", "-1:3", "0:1.5",
                            "0:100000", "0:4294967296", " 0:3"})
    EXPECT_FALSE(parse_frames(wrong)) << wrong;
}

}  // namespace
}  // namespace metamer::client
