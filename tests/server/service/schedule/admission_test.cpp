#include "server/service/schedule/admission.h"

#include <gtest/gtest.h>

#include <limits>

namespace metamer::service::test {

namespace {

constexpr std::uint64_t mebi = std::uint64_t{1} << 20;
constexpr std::uint64_t huge = std::numeric_limits<std::uint64_t>::max();
using Verdict = Admission::Verdict;

}  // namespace

TEST(Admission, MoreOfAnythingTakesNoLess) {
  const JobSize plain{.asset_bytes = mebi, .pixels = 1000, .triangles = 1000};
  const std::uint64_t base = memory_estimate(plain);
  for (const std::uint64_t more : {std::uint64_t{1}, mebi, huge / 2, huge}) {
    JobSize size = plain;
    size.asset_bytes = std::max(size.asset_bytes, more);
    EXPECT_GE(memory_estimate(size), base);
    size = plain;
    size.pixels = std::max(size.pixels, more);
    EXPECT_GE(memory_estimate(size), base);
    size = plain;
    size.triangles = std::max(size.triangles, more);
    EXPECT_GE(memory_estimate(size), base);
  }
  JobSize size = plain;
  size.keeps_factors = true;
  EXPECT_GT(memory_estimate(size), base);
}

TEST(Admission, APictureTakesItsPixelsTwice) {
  // X Y Z in f32, in the worker's memory and in the daemon's.
  const JobSize without{.pixels = 1};
  const JobSize with{.pixels = 1 + 3840 * 2160};
  EXPECT_EQ(memory_estimate(with) - memory_estimate(without), 2u * 12 * 3840 * 2160);
}

TEST(Admission, WhatFitsStartsWhatFitsAloneWaitsWhatNeverFitsIsToldSo) {
  EXPECT_EQ(admit(600 * mebi, 400 * mebi, 1000 * mebi).verdict, Verdict::starts);
  const Admission waits = admit(600 * mebi, 401 * mebi, 1000 * mebi);
  EXPECT_EQ(waits.verdict, Verdict::waits);
  EXPECT_EQ(waits.reason,
            "waits for memory: it takes about 600 MiB, and of 1000 MiB others have 401 MiB");
  const Admission never = admit(1000 * mebi + 1, 0, 1000 * mebi);
  EXPECT_EQ(never.verdict, Verdict::never);
  EXPECT_EQ(never.reason,
            "it takes about 1001 MiB of memory, and jobs may have 1000 MiB (--memory)");
  EXPECT_EQ(admit(huge, huge, huge).verdict, Verdict::starts);
  EXPECT_EQ(admit(huge, huge, huge - 1).verdict, Verdict::never);
  EXPECT_EQ(admit(huge, huge, 0).verdict, Verdict::starts);
}

}  // namespace metamer::service::test
