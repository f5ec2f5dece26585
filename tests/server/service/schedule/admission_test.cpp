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
    for (std::uint64_t JobSize::*of : {&JobSize::scene_bytes, &JobSize::spectra, &JobSize::bands,
                                       &JobSize::picture_values, &JobSize::largest_picture}) {
      size = plain;
      size.*of = more;
      EXPECT_GE(memory_estimate(size), base);
      EXPECT_GT(memory_allowance(size, 256),
                memory_estimate(size) - (memory_estimate(size) == huge));
    }
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

/// Scenes whose workers were watched, by what they took at most of memory of their own, in MiB
/// beyond what they had (tests/bench/memory_bench.py, release, two threads).
struct Measured {
  const char* scene;
  JobSize size;
  std::uint64_t used;   // touched
  std::uint64_t asked;  // counted against RLIMIT_DATA
};
constexpr Measured measured[] = {
    {"gallery, 61 wavelengths", {20'000, 16'000, 1600 * 912, 136, 10, 61}, 4, 16},
    {"gallery, verify", {20'000, 16'000, 400 * 228, 136, 10, 61}, 38, 50},
    {"gallery, GL", {20'000, 16'000, 1600 * 912, 136, 10, 61}, 52, 71},
    {"booth, GL", {1'080'000, 16'000, 800 * 880, 42'524, 21, 61}, 39, 159},
    {"a million triangles", {18'000'000, 300, 320 * 240, 1'002'528, 3, 3}, 103, 117},
    {"a million triangles, GL", {18'000'000, 300, 320 * 240, 1'002'528, 3, 3}, 208, 356},
    {"1,500 materials, 1,881 wavelengths", {150'000, 150'000, 320 * 240, 0, 2502, 1881}, 45, 58},
    {"100,000 ellipsoids", {9'000'000, 9'000'000, 320 * 240, 0, 3, 3}, 551, 574},
    {"256 lights, 4,096 materials, linear", {700'000, 700'000, 160 * 120, 0, 7510, 1}, 183, 195},
    {"a flat texture of 4096 pixels squared",
     {.asset_bytes = 56'200,
      .scene_bytes = 400,
      .pixels = 32 * 32,
      .picture_values = 4 << 24,
      .largest_picture = 4 << 24},
     395,
     450},
};

TEST(Admission, WhatWasMeasuredIsWithinTheEstimateAndWithinHalfOfWhatIsAllowed) {
  for (const Measured& one : measured) {
    SCOPED_TRACE(one.scene);
    EXPECT_LE(one.used * mebi, memory_estimate(one.size));
    EXPECT_LE(2 * one.asked * mebi, memory_allowance(one.size, 2));
  }
}

TEST(Admission, BeforeThePlanIsKnownAsMuchIsAllowedAsTheTablesMayTake) {
  // Compiled and prepared before the daemon hears of spectra.
  for (const Measured& one : measured)
    EXPECT_LE(one.asked * mebi, memory_allowance({.asset_bytes = one.size.asset_bytes,
                                                  .scene_bytes = one.size.scene_bytes,
                                                  .picture_values = one.size.picture_values,
                                                  .largest_picture = one.size.largest_picture},
                                                 2))
        << one.scene;
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
