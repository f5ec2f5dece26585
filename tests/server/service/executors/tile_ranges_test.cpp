// Which results of ranges count: the first whole one of each, once.

#include "server/service/executors/tile_ranges.h"

#include "../jobs/job_fixture.h"
#include "rendered_range.h"
#include "server/service/limits.h"

namespace metamer::service::test {

namespace {

using Verdict = TileRanges::Verdict;

class TileRangesTest : public JobTest {
 protected:
  std::shared_ptr<Job> job_ = make_job();
  std::uint64_t attempts_ = 0;
  void SetUp() override {
    job_->start();
    ASSERT_TRUE(job_->plan(plan(48, 48, 16)));
    ASSERT_TRUE(job_->make_film());
  }
  RangeResult rendered(const RangeOrder& order) const { return render(order, job_->tiles()); }
};

std::vector<TileRange> all_of(TileRanges& ranges) {
  std::vector<TileRange> all;
  while (const auto order = ranges.hand_out()) all.push_back(order->range);
  return all;
}

}  // namespace

TEST_F(TileRangesTest, AreTheTilesThatAreMissingAndNoOthers) {
  TileRanges whole(*job_, attempts_, 4);
  EXPECT_EQ(all_of(whole), (std::vector<TileRange>{{0, 4}, {4, 4}, {8, 1}}));
  job_->add_tile(2, 1);
  job_->add_tile(3, 1);
  TileRanges rest(*job_, attempts_, 4);
  EXPECT_EQ(all_of(rest), (std::vector<TileRange>{{0, 2}, {4, 4}, {8, 1}}));
  EXPECT_EQ(attempts_, 6u);
}

TEST_F(TileRangesTest, CountOnceWhoeverIsFirst) {
  TileRanges ranges(*job_, attempts_, 9);
  const RangeOrder slow = ranges.hand_out().value();
  const RangeOrder fast = ranges.hand_out_again(slow.attempt).value();
  EXPECT_EQ(fast.range, slow.range);
  EXPECT_NE(fast.attempt, slow.attempt);
  EXPECT_EQ(ranges.take(rendered(fast)), Verdict::counts);
  EXPECT_TRUE(ranges.complete());
  const auto rays = job_->summary().tiles_done();
  EXPECT_EQ(ranges.take(rendered(slow)), Verdict::late);
  EXPECT_EQ(ranges.take(rendered(fast)), Verdict::late);
  EXPECT_EQ(job_->summary().tiles_done(), rays);
  EXPECT_FALSE(ranges.hand_out_again(slow.attempt));
}

TEST_F(TileRangesTest, ThatAreDamagedOrNotTheirOwnAreRefusedAndHandedOutAgain) {
  const auto refused = [&](const std::function<void(RangeResult&)>& damage) {
    TileRanges ranges(*job_, attempts_, 3);
    const RangeOrder order = ranges.hand_out().value();
    RangeResult result = rendered(order);
    damage(result);
    EXPECT_EQ(ranges.take(result), Verdict::damaged);
    EXPECT_EQ(job_->tiles_done(), 0u);
    EXPECT_EQ(ranges.take(rendered(order)), Verdict::late) << "the attempt is over";
    EXPECT_EQ(ranges.hand_out().value().range, order.range);
  };
  refused([](RangeResult& result) { result.tiles[1].xyz[5] ^= 1; });
  refused([](RangeResult& result) { ++result.tiles[0].rays; });
  refused([](RangeResult& result) { result.digest[31] ^= 0x80; });
  refused([](RangeResult& result) { std::swap(result.tiles[0], result.tiles[1]); });
  refused([](RangeResult& result) { result.tiles.pop_back(); });
  // Whole, but other tiles than were asked for.
  refused([&](RangeResult& result) {
    const RangeOrder other{job_->id(), result.attempt, {3, 3}};
    result = render(other, job_->tiles());
  });
  refused([&](RangeResult& result) {
    const RangeOrder other{job_->id() + 1, result.attempt, {0, 3}};
    result = render(other, job_->tiles());
  });
}

TEST_F(TileRangesTest, OfAnEarlierPlanAreNobodys) {
  RangeOrder before;
  {
    TileRanges ranges(*job_, attempts_, 9);
    before = ranges.hand_out().value();
  }
  TileRanges ranges(*job_, attempts_, 9);
  const RangeOrder now = ranges.hand_out().value();
  EXPECT_EQ(ranges.take(rendered(before)), Verdict::late);
  EXPECT_EQ(ranges.take(rendered(now)), Verdict::counts);
}

TEST_F(TileRangesTest, ThatAreLostAreHandedOutAgainUntilItIsTheJobsDoing) {
  TileRanges ranges(*job_, attempts_, 9);
  for (std::uint32_t losses = 0; losses < max_losses; ++losses) {
    EXPECT_FALSE(ranges.hopeless());
    const RangeOrder order = ranges.hand_out().value();
    EXPECT_FALSE(ranges.hand_out()) << "it is out";
    ranges.lose(order.attempt);
    ranges.lose(order.attempt);  // Said twice, it is one loss.
  }
  EXPECT_TRUE(ranges.hopeless());
}

TEST_F(TileRangesTest, ThatAreWithdrawnAreHandedOutAgainAndCountForNothing) {
  TileRanges ranges(*job_, attempts_, 9);
  const std::size_t all = ranges.waiting();
  for (std::uint32_t i = 0; i < 3 * max_losses; ++i) {
    const RangeOrder order = ranges.hand_out().value();
    EXPECT_EQ(ranges.waiting(), all - 1);
    ranges.withdraw(order.attempt);
    EXPECT_EQ(ranges.take(rendered(order)), Verdict::late);
  }
  EXPECT_FALSE(ranges.hopeless());
  EXPECT_EQ(ranges.waiting(), all);
}

TEST_F(TileRangesTest, ALossOfOneOfTwoLeavesTheOther) {
  TileRanges ranges(*job_, attempts_, 9);
  const RangeOrder one = ranges.hand_out().value();
  const RangeOrder other = ranges.hand_out_again(one.attempt).value();
  ranges.lose(one.attempt);
  EXPECT_FALSE(ranges.hand_out());
  EXPECT_EQ(ranges.take(rendered(other)), Verdict::counts);
}

TEST_F(TileRangesTest, OfACancelledJobAreDropped) {
  TileRanges ranges(*job_, attempts_, 9);
  const RangeOrder order = ranges.hand_out().value();
  job_->cancel();
  EXPECT_EQ(ranges.take(rendered(order)), Verdict::late);
  EXPECT_FALSE(ranges.complete());
}

TEST(RangeDigest, IsOfTheBytesThatItsDefinitionNames) {
  // By Python: sha256(pack('<6Q', 7, 3, 0, 1, 10, 3) + b'xyz' + pack('<Q', 2) + b'fa').
  EXPECT_EQ(to_hex(digest_of({7, 3, {0, 1}}, {{10, "xyz", "fa"}})),
            "e9b826929e552237aa41bc7b3edf86d3919c57dc8d0cbf3b793b781694d2499c");
}

}  // namespace metamer::service::test
