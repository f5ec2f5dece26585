// The jobs of a trade, one after the other, told of pictures that were made by hand.
#include "client/tools/tradeoff/tradeoff_steps.h"

#include <gtest/gtest.h>

#include <utility>

namespace metamer::client {
namespace {

/// A finished job with a picture of one grey pixel.
JobRecord finished_job(double seconds, float grey) {
  JobRecord job;
  job.plan.emplace();
  job.plan->set_width(1);
  job.plan->set_height(1);
  auto film = Film::make(*job.plan);
  EXPECT_TRUE(film);
  const std::vector<float> xyz(3, grey);
  v1::Tile tile;
  tile.set_width(1);
  tile.set_height(1);
  tile.set_xyz(xyz.data(), xyz.size() * sizeof(float));
  EXPECT_TRUE(film->add(tile));
  job.film = std::move(*film);
  job.last.mutable_finished()->mutable_timing()->set_render(seconds);
  return job;
}

JobRecord failed_job(const std::string& why) {
  JobRecord job;
  job.last.mutable_failed()->set_reason(why);
  return job;
}

class TradeoffStepsTest : public testing::Test {
 protected:
  v1::Scene scene;
  std::vector<Asset> assets;
  std::size_t cases = tradeoff_cases().size();
};

TEST_F(TradeoffStepsTest, AskForTheReferenceAndEveryCaseInEachRound) {
  TradeoffSteps steps({scene, assets, "scene"}, 2);
  EXPECT_EQ(steps.jobs(), 1 + 2 * cases);
  std::vector<std::string> due;
  while (const auto submission = steps.next()) {
    EXPECT_EQ(steps.jobs_done(), due.size());
    EXPECT_EQ(submission->request.name(), "tradeoff: " + steps.due());
    EXPECT_FALSE(submission->request.check_only());
    due.push_back(steps.due());
    ASSERT_TRUE(steps.ended(finished_job(1, 0.2F)));
  }
  ASSERT_EQ(due.size(), steps.jobs());
  EXPECT_EQ(due[0], "the reference");
  for (std::size_t i = 0; i < cases; ++i) {
    EXPECT_EQ(due[1 + i], tradeoff_cases()[i].stem);
    EXPECT_EQ(due[1 + cases + i], tradeoff_cases()[i].stem);
  }
}

TEST_F(TradeoffStepsTest, ACaseThatFailsOrIsRefusedIsARowWithItsReasonAndIsNotTriedAgain) {
  TradeoffSteps steps({scene, assets, "scene"}, 3);
  ASSERT_TRUE(steps.ended(finished_job(1, 0.2F)));
  ASSERT_TRUE(steps.ended(failed_job("no room")));
  ASSERT_TRUE(steps.refused("not here"));
  std::size_t more = 0;
  for (; steps.next(); ++more) ASSERT_TRUE(steps.ended(finished_job(2, 0.3F)));
  EXPECT_EQ(more, 3 * (cases - 2));
  const auto& rows = steps.so_far().rows;
  ASSERT_EQ(rows.size(), cases);
  EXPECT_EQ(rows[0].failure, "no room");
  EXPECT_EQ(rows[1].failure, "not here");
  for (std::size_t i = 2; i < cases; ++i) {
    EXPECT_EQ(rows[i].failure, "");
    EXPECT_GT(rows[i].error.maximum, 0);
    EXPECT_EQ(rows[i].front, i == 2) << "the others are as dear and as far off";
  }
}

TEST_F(TradeoffStepsTest, EndWhereEveryCaseFails) {
  TradeoffSteps steps({scene, assets, "scene"}, 100);
  ASSERT_TRUE(steps.ended(finished_job(1, 0.2F)));
  for (std::size_t i = 0; i < cases; ++i) {
    ASSERT_TRUE(steps.next());
    ASSERT_TRUE(steps.refused("not here"));
  }
  EXPECT_FALSE(steps.next());
}

TEST_F(TradeoffStepsTest, AReferenceThatFailsAndAJobThatIsCancelledStopIt) {
  TradeoffSteps steps({scene, assets, "scene"}, 1);
  const auto failed = steps.ended(failed_job("no room"));
  ASSERT_FALSE(failed);
  EXPECT_EQ(failed.error().kind, TradeoffStop::Kind::reference);
  EXPECT_EQ(failed.error().problem.message, "no room");
  ASSERT_TRUE(steps.ended(finished_job(1, 0.2F)));
  JobRecord cancelled;
  cancelled.last.mutable_cancelled();
  const auto stopped = steps.ended(cancelled);
  ASSERT_FALSE(stopped);
  EXPECT_EQ(stopped.error().kind, TradeoffStop::Kind::cancelled);
}

}  // namespace
}  // namespace metamer::client
