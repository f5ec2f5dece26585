// A worker shared by users, simulated: what each gets of it, and how long each waits.
#include "server/service/schedule/fair_share.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <random>
#include <vector>

namespace metamer::service::test {

namespace {

constexpr double quantum = 2;

struct SimulatedJob {
  std::string user;
  double seconds = 0;
  double comes = 0;
  std::int32_t priority = 0;
};

/// One worker that gives each turn so much at most, as the supervisor does.
class Simulation {
 public:
  std::map<std::string, double> shares;
  std::map<std::string, double> given;    // seconds, by user
  std::map<std::string, double> longest;  // without a turn while a job waits, by user
  std::vector<std::size_t> finished;      // in order
  std::function<double()> turn_length = [] { return quantum; };
  double time = 0;

  void add(SimulatedJob job) { jobs_.push_back({std::move(job)}); }

  void run_until(double end) {
    while (time < end && step()) {
    }
  }
  std::size_t known_users() const { return fair_.size(); }
  /// All is forgotten but what is kept.
  void restart() {
    const auto kept = fair_.leads();
    fair_ = FairShare();
    note_presence();
    fair_.restore(kept);
  }

 private:
  struct Known {
    SimulatedJob job;
    double done = 0;
    bool over = false;
  };
  double share(const std::string& user) const {
    const auto known = shares.find(user);
    return known == shares.end() ? 1 : known->second;
  }
  bool waits(const Known& one) const { return !one.over && one.job.comes <= time; }

  void note_presence() {
    std::map<std::string, bool> present;
    for (const Known& one : jobs_) present[one.job.user] |= waits(one);
    for (const auto& [user, is_present] : present) {
      fair_.set_present(user, is_present);
      if (!is_present) waiting_since_.erase(user);
      if (is_present) waiting_since_.emplace(user, time);
    }
  }

  bool step() {
    note_presence();
    std::vector<Claim> claims;
    std::vector<std::size_t> of;
    for (std::size_t i = 0; i < jobs_.size(); ++i) {
      if (!waits(jobs_[i])) continue;
      claims.push_back({jobs_[i].job.user, jobs_[i].job.priority, i});
      of.push_back(i);
    }
    const auto next = fair_.choose(claims);
    if (!next) {
      double later = std::numeric_limits<double>::infinity();
      for (const Known& one : jobs_)
        if (!one.over && one.job.comes > time) later = std::min(later, one.job.comes);
      time = later;
      return std::isfinite(later);
    }
    Known& one = jobs_[of[*next]];
    const std::string& user = one.job.user;
    fair_.begin(user, share(user));
    longest[user] = std::max(longest[user], time - waiting_since_[user]);
    const double turn = std::min(turn_length(), one.job.seconds - one.done);
    fair_.charge(user, share(user), turn);
    one.done += turn;
    given[user] += turn;
    time += turn;
    waiting_since_[user] = time;
    one.over = one.done >= one.job.seconds;
    if (one.over) finished.push_back(of[*next]);
    return true;
  }

  FairShare fair_;
  std::vector<Known> jobs_;
  std::map<std::string, double> waiting_since_;
};

}  // namespace

TEST(FairShare, EqualSharesAndUnequalDemandsGetEqualTime) {
  Simulation one;
  one.add({"long", 1000});
  for (int i = 0; i < 1000; ++i) one.add({"short", 1});
  for (const double until : {100.0, 500.0, 1900.0}) {
    one.run_until(until);
    EXPECT_NEAR(one.given["long"] / one.given["short"], 1, 0.05) << until;
  }
}

TEST(FairShare, HoweverLongTurnsAreUsersDifferByOneOfEachAndNoMore) {
  // As long as a loaded machine makes them: what a turn costs more its user waits for.
  Simulation one;
  std::mt19937 random(3);
  constexpr double longest = 30, short_job = 3;
  one.turn_length = [&] { return std::uniform_real_distribution(0.5, longest)(random); };
  one.add({"long", 1e6});
  for (int i = 0; i < 700; ++i) one.add({"short", short_job});
  for (double until = 100; until <= 4000; until += 100) {
    one.run_until(until);
    const double for_turns = one.given["short"] / short_job * least_turn;
    EXPECT_LE(std::abs(one.given["long"] - one.given["short"]), longest + short_job + for_turns)
        << until;
  }
  EXPECT_NEAR(one.given["long"] / one.given["short"], 1, 0.05);
}

TEST(FairShare, RestartsFavourNobody) {
  Simulation one;
  one.shares = {{"heavy", 2}};
  one.add({"greedy", 10'000});
  one.add({"heavy", 10'000});
  for (int i = 0; i < 400; ++i) one.add({"modest", 0.7});
  for (double time = 0; time < 1000; time = one.time + 0.1) {
    one.run_until(time);
    one.restart();
  }
  EXPECT_NEAR(one.given["greedy"], one.given["modest"], 2 * quantum);
  EXPECT_NEAR(one.given["heavy"], 2 * one.given["modest"], 3 * quantum);
}

TEST(FairShare, WhatIsSpentOnOneWhoHasGoneIsChargedAllTheSame) {
  FairShare fair;
  fair.set_present("stays", true);
  fair.set_present("goes", true);
  fair.begin("goes", 1);
  fair.set_present("goes", false);
  fair.begin("stays", 1);
  fair.charge("stays", 1, 1);
  fair.begin("stays", 1);
  EXPECT_EQ(fair.size(), 1U);
  fair.charge("goes", 1, 5);  // until its worker has stopped
  fair.set_present("goes", true);
  const std::vector<Claim> claims{{"goes"}, {"stays"}};
  fair.charge("stays", 1, 4);
  EXPECT_EQ(fair.choose(claims), 1U);
  fair.charge("stays", 1, 2);
  EXPECT_EQ(fair.choose(claims), 0U);
}

TEST(FairShare, SharesAreProportions) {
  Simulation one;
  one.shares = {{"one", 1}, {"three", 3}};
  one.add({"one", 10'000});
  one.add({"three", 10'000});
  one.run_until(4000);
  EXPECT_NEAR(one.given["three"] / one.given["one"], 3, 0.03);
}

TEST(FairShare, WhoComesLateGetsItsShareFromThenOnAndNoCredit) {
  Simulation one;
  one.add({"early", 10'000});
  one.add({"late", 10'000, 1000});
  one.run_until(1000);
  const double before = one.given["early"];
  one.run_until(1400);
  EXPECT_NEAR(one.given["late"], 200, 2 * quantum);
  EXPECT_NEAR(one.given["early"] - before, 200, 2 * quantum);
}

TEST(FairShare, WhoHasBeenAwayGetsNoCreditForIt) {
  Simulation one;
  one.add({"a", 10'000});
  one.add({"b", 10});
  one.add({"b", 10'000, 2000});
  one.run_until(2000);
  const double before = one.given["a"];
  one.run_until(2400);
  EXPECT_NEAR(one.given["a"] - before, 200, 2 * quantum);
}

TEST(FairShare, NobodyWaitsForMoreThanATurnOfEachOther) {
  Simulation one;
  std::mt19937 random(1);
  constexpr int users = 20;
  for (int i = 0; i < users; ++i) {
    const std::string user = "user " + std::to_string(i);
    one.shares[user] = std::pow(10.0, std::uniform_real_distribution(-1.0, 1.0)(random));
    for (int j = 0; j < 40; ++j)
      one.add({user, std::uniform_real_distribution(0.0, 8.0)(random),
               std::uniform_real_distribution(0.0, 3000.0)(random)});
  }
  // One with the lowest share, who comes now and then: an own turn is charged as much as it weighs.
  one.shares["rare"] = 1;
  for (int i = 0; i < 20; ++i) one.add({"rare", 0.01, 100.0 * i});
  one.run_until(1e9);
  EXPECT_EQ(one.finished.size(), std::size_t{users * 40 + 20});
  EXPECT_LE(one.longest["rare"], (users + 1) * quantum);
}

TEST(FairShare, JobsOfNoLengthAreNotFree) {
  Simulation one;
  for (int i = 0; i < 3000; ++i) one.add({"nothing", 0});
  one.add({"something", 20});
  one.run_until(19);
  EXPECT_GE(one.given["something"], 19);
  one.run_until(1e9);
  EXPECT_EQ(one.finished.size(), 3001u);
}

TEST(FairShare, AUsersJobsGoByPriorityThenAsTheyCame) {
  Simulation one;
  one.add({"a", 1, 0, 0});
  one.add({"a", 1, 0, 5});
  one.add({"a", 1, 0, -5});
  one.add({"a", 1, 0, 5});
  one.run_until(1e9);
  EXPECT_EQ(one.finished, (std::vector<std::size_t>{1, 3, 0, 2}));
}

TEST(FairShare, APriorityTakesNothingFromOthers) {
  Simulation one;
  one.add({"loud", 1000, 0, 100});
  one.add({"quiet", 1000, 0, -100});
  one.run_until(1000);
  EXPECT_NEAR(one.given["loud"], one.given["quiet"], 2 * quantum);
}

TEST(FairShare, TheOrderInWhichClaimsStandChangesNothing) {
  std::vector<Claim> claims;
  const std::vector<std::string> names{"a", "b", "c", "d"};
  FairShare fair;
  for (const std::string& name : names) fair.set_present(name, true);
  for (std::uint64_t i = 0; i < 40; ++i)
    claims.push_back({names[i % 4], static_cast<std::int32_t>(i % 3), i});
  std::mt19937 random(2);
  for (int turn = 0; turn < 100; ++turn) {
    const Claim chosen = claims[*fair.choose(claims)];
    std::shuffle(claims.begin(), claims.end(), random);
    EXPECT_EQ(claims[*fair.choose(claims)].order, chosen.order);
    fair.begin(chosen.user, 1);
    fair.charge(chosen.user, 1, 1.0 / (1 + turn % 7));
  }
}

TEST(FairShare, ThousandsOfUsersHaveATurnEach) {
  FairShare fair;
  std::vector<std::string> names;
  for (int i = 0; i < 5000; ++i) names.push_back("user " + std::to_string(i));
  std::vector<Claim> claims;
  for (const std::string& name : names) {
    fair.set_present(name, true);
    claims.push_back({name});
  }
  std::map<std::string, int> turns;
  for (std::size_t turn = 0; turn < 500; ++turn) {
    const Claim chosen = claims[*fair.choose(claims)];
    fair.begin(chosen.user, 1);
    fair.charge(chosen.user, 1, 1e6);
    EXPECT_EQ(++turns[std::string(chosen.user)], 1);
  }
  for (const std::string& name : names) fair.set_present(name, false);
  EXPECT_EQ(fair.size(), 0u);
}

TEST(FairShare, HugeNumbersKeepTheProportion) {
  FairShare fair;
  const std::vector<Claim> claims{{"least"}, {"most"}};
  for (const Claim& claim : claims) fair.set_present(claim.user, true);
  const auto share = [](std::string_view user) { return user == "most" ? max_share : min_share; };
  std::map<std::string, double> given;
  constexpr double year = 3.2e7;
  for (int turn = 0; turn < 3'000'000; ++turn) {
    const std::string_view user = claims[*fair.choose(claims)].user;
    fair.begin(user, share(user));
    fair.charge(user, share(user), year);
    given[std::string(user)] += year;
  }
  EXPECT_NEAR(given["most"] / given["least"], max_share / min_share, 0.5 * max_share / min_share);
}

TEST(FairShare, OfWhomNothingIsOwedNothingIsKept) {
  FairShare fair;
  fair.set_present("stays", true);
  for (int i = 0; i < 1000; ++i) {
    const std::string user = "passes " + std::to_string(i);
    fair.set_present(user, true);
    fair.begin(user, 1);
    fair.charge(user, 1, 0.5);
    fair.set_present(user, false);
    fair.begin("stays", 1);
    fair.charge("stays", 1, 1);
  }
  EXPECT_LE(fair.size(), 3u);
}

TEST(TurnSeconds, AreLongerWhereBeginningsAreAndStillHoldNobodyUpForLong) {
  EXPECT_EQ(turn_seconds(2, 0.01), 2);
  EXPECT_EQ(turn_seconds(2, 1), 20);
  EXPECT_EQ(turn_seconds(2, 12), 30);  // a mesh of millions of triangles
  EXPECT_EQ(turn_seconds(60, 12), 60);
  EXPECT_EQ(turn_seconds(0, 0), 0);
}

TEST(FairShare, NobodyIsNext) {
  const FairShare fair;
  EXPECT_FALSE(fair.choose({}));
}

}  // namespace metamer::service::test
