// What should run, held against what Slurm lists.
#include "server/service/executors/slurm/task_book.h"

#include <gtest/gtest.h>

namespace metamer::service {
namespace {

using State = ListedTask::State;

ListedTask listed(const std::string& name, std::optional<std::uint32_t> index,
                  const std::string& word, const std::string& node = {}) {
  return {.name = name, .index = index, .state = state_of(word), .word = word, .node = node};
}

class SlurmTaskBook : public testing::Test {
 protected:
  SlurmTaskBook() { book_.add("a", 2, 100); }
  TaskBook book_{10};
};

TEST_F(SlurmTaskBook, LosesNoTaskThatWaitsOrRunsHoweverLong) {
  for (double now = 100; now < 10'000; now += 100)
    EXPECT_TRUE(
        book_
            .reconcile({listed("a", 0, "RUNNING", "n1"), listed("a", std::nullopt, "PENDING")}, now)
            .empty());
  EXPECT_EQ(book_.seen({"a", 0}).node, "n1");
  EXPECT_EQ(book_.seen({"a", 1}).state, State::waiting);
}

TEST_F(SlurmTaskBook, TaskThatSlurmForgotIsLostAfterAWhileAndIsNobodysFault) {
  EXPECT_TRUE(book_.reconcile({listed("a", 0, "RUNNING")}, 109).empty());
  const auto losses = book_.reconcile({listed("a", 0, "RUNNING")}, 110);
  ASSERT_EQ(losses.size(), 1u);
  EXPECT_EQ(losses[0].key, (TaskKey{"a", 1}));
  EXPECT_EQ(losses[0].reason, "Slurm does not know it any more");
  EXPECT_FALSE(losses[0].counts);
  EXPECT_FALSE(book_.has({"a", 1}));
  EXPECT_TRUE(book_.has({"a", 0}));
}

TEST_F(SlurmTaskBook, EndedTaskHasAWhileForItsResultToBeSeen) {
  const std::vector<ListedTask> listing = {listed("a", 0, "NODE_FAIL", "n2"),
                                           listed("a", 1, "RUNNING", "n1")};
  EXPECT_TRUE(book_.reconcile({listed("a", std::nullopt, "PENDING")}, 200).empty());
  EXPECT_TRUE(book_.reconcile(listing, 209).empty());
  const auto losses = book_.reconcile(listing, 211);
  ASSERT_EQ(losses.size(), 1u);
  EXPECT_EQ(losses[0].reason, "ended as NODE_FAIL without a result on n2");
  EXPECT_TRUE(losses[0].counts);
}

TEST_F(SlurmTaskBook, WhatSlurmTookBackIsNotTheJobsDoing) {
  for (const char* word : {"PREEMPTED", "BOOT_FAIL", "REVOKED"}) {
    TaskBook book(1);
    book.add("a", 1, 0);
    const auto losses = book.reconcile({listed("a", 0, word)}, 5);
    ASSERT_EQ(losses.size(), 1u) << word;
    EXPECT_FALSE(losses[0].counts) << word;
  }
}

TEST_F(SlurmTaskBook, OneThatLivesCountsWhereSlurmListsATaskTwice) {
  for (const bool first : {true, false}) {
    TaskBook book(1);
    book.add("a", 1, 0);
    const ListedTask dead = listed("a", 0, "NODE_FAIL", "n1");
    const ListedTask alive = listed("a", 0, "RUNNING", "n2");
    EXPECT_TRUE(
        book.reconcile(first ? std::vector{dead, alive} : std::vector{alive, dead}, 5).empty());
    EXPECT_EQ(book.seen({"a", 0}).node, "n2");
  }
}

TEST_F(SlurmTaskBook, StrangersAreThoseThatLiveAndNobodyKnows) {
  const auto strangers =
      book_.strangers({listed("a", 0, "RUNNING"), listed("b", 0, "RUNNING"),
                       listed("b", std::nullopt, "PENDING"), listed("c", 0, "COMPLETED")});
  EXPECT_EQ(strangers, std::vector<std::string>{"b"});
}

TEST_F(SlurmTaskBook, NumbersAndPlacesOfOthersMeanNothing) {
  EXPECT_TRUE(book_.reconcile({listed("a", 7, "FAILED"), listed("aa", 0, "FAILED")}, 105).empty());
  book_.erase({"a", 0});
  book_.erase({"a", 1});
  EXPECT_TRUE(book_.reconcile({}, 1000).empty());
  EXPECT_EQ(book_.size(), 0u);
}

}  // namespace
}  // namespace metamer::service
