#include "server/service/schedule/retention.h"

#include <gtest/gtest.h>

#include <vector>

namespace metamer::service::test {

namespace {

using Measure = Retention::Measure;
constexpr std::uint64_t none = 0;

/// All that goes where all may take `most`, in order.
std::vector<std::uint64_t> beyond(Retention& kept, Measure measure, std::uint64_t most,
                                  std::uint64_t newest = none) {
  std::vector<std::uint64_t> gone;
  while (const auto job = kept.take_beyond(measure, most, newest)) gone.push_back(*job);
  return gone;
}

using Jobs = std::vector<std::uint64_t>;

}  // namespace

TEST(Retention, TheOldestGoesFirst) {
  Retention kept;
  for (const std::uint64_t job : {3, 1, 2}) kept.add("one", 1, {job, 10, 0});
  EXPECT_EQ(beyond(kept, Measure::jobs, 3), Jobs());
  EXPECT_EQ(beyond(kept, Measure::jobs, 2), Jobs{3});
  EXPECT_EQ(beyond(kept, Measure::bytes, 10), Jobs{1});
  EXPECT_EQ(kept.total(Measure::bytes), 10U);
  EXPECT_EQ(beyond(kept, Measure::bytes, 0), Jobs{2});
  EXPECT_EQ(kept.total(Measure::jobs), 0U);
}

TEST(Retention, WhoIsWithinItsShareLosesNothingToOthers) {
  Retention kept;
  kept.add("modest", 1, {1, 40, 0});
  for (std::uint64_t job = 10; job < 110; ++job) {
    kept.add("greedy", 1, {job, 10, 0});
    for (const std::uint64_t gone : beyond(kept, Measure::bytes, 100, job)) EXPECT_GE(gone, 10U);
  }
  EXPECT_EQ(kept.total(Measure::bytes), 100U) << "what nobody else takes is not lost";
  kept.add("modest", 1, {2, 10, 0});
  EXPECT_EQ(beyond(kept, Measure::bytes, 100, 2), Jobs{104}) << "its share is free for it at once";
  kept.add("modest", 1, {3, 10, 0});
  EXPECT_EQ(beyond(kept, Measure::bytes, 100, 3), Jobs{1}) << "beyond it its own goes";
}

TEST(Retention, SharesAreWeights) {
  Retention kept;
  std::uint64_t job = 0;
  for (int i = 0; i < 100; ++i)
    for (const auto& [user, share] : {std::pair{"one", 1.0}, std::pair{"three", 3.0}}) {
      kept.add(user, share, {++job, 1, 0});
      beyond(kept, Measure::jobs, 40, job);
    }
  std::size_t of_one = 0;
  for (const std::uint64_t gone : beyond(kept, Measure::jobs, 0)) of_one += gone % 2;
  EXPECT_EQ(of_one, 10U);
}

TEST(Retention, TheNewestStaysHoweverLargeAndCostsOthersNothing) {
  Retention kept;
  kept.add("modest", 1, {1, 10, 0});
  kept.add("greedy", 1, {2, 10, 0});
  kept.add("greedy", 1, {3, 1'000'000, 0});
  EXPECT_EQ(beyond(kept, Measure::bytes, 20, 3), Jobs{2});
  kept.add("modest", 1, {4, 0, 0});
  EXPECT_EQ(beyond(kept, Measure::bytes, 20, 4), Jobs{3});
}

TEST(Retention, WithoutRoomNothingButTheNewestStays) {
  Retention kept;
  kept.add("one", 1, {1, 3, 0});
  kept.add("other", 1, {2, 5, 0});
  EXPECT_EQ(beyond(kept, Measure::bytes, 0, 2), Jobs{1});
  EXPECT_EQ(beyond(kept, Measure::jobs, 1, 2), Jobs());
}

TEST(Retention, WhatIsTooOldGoesWhoeverHasIt) {
  Retention kept;
  kept.add("one", 1, {1, 1, 100});
  kept.add("other", 1, {2, 1, 200});
  kept.add("one", 1, {3, 1, 300});
  EXPECT_FALSE(kept.take_before(100));
  EXPECT_EQ(kept.take_before(250), 1U);
  EXPECT_EQ(kept.take_before(250), 2U);
  EXPECT_FALSE(kept.take_before(250));
  EXPECT_EQ(kept.total(Measure::jobs), 1U);
}

}  // namespace metamer::service::test
