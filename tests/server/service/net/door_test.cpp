#include "server/service/net/door.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

namespace metamer::service {

namespace {

/// A door whose newcomers leave as soon as they are closed, or stay.
struct Closing {
  Door door{8, 4};
  std::vector<std::string> closed;
  std::map<std::string, Door::Place> places;

  void come(const std::string& source, const std::string& name) {
    const auto place = door.enter(source);
    place->close = [this, name] { closed.push_back(name); };
    places.emplace(name, place);
  }
};

}  // namespace

TEST(Door, ASourceBeyondItsShareLosesItsOldest) {
  Closing at;
  at.come("other", "other");
  for (int i = 0; i < 6; ++i) at.come("flood", std::to_string(i));
  EXPECT_EQ(at.closed, (std::vector<std::string>{"0", "1"}));
}

TEST(Door, WhenItIsFullTheGreediestSourceMakesRoom) {
  Closing at;
  at.come("one", "one");
  for (int i = 0; i < 4; ++i) at.come("many", "many" + std::to_string(i));
  for (int i = 0; i < 3; ++i) at.come("some", "some" + std::to_string(i));
  EXPECT_TRUE(at.closed.empty());
  at.come("late", "late");
  EXPECT_EQ(at.closed, (std::vector<std::string>{"many0"}));
}

TEST(Door, WhoIsClosedCountsNoMoreAndWhoLeavesGivesItsPlaceBack) {
  Closing at;
  for (int i = 0; i < 4; ++i) at.come("a", std::to_string(i));
  at.door.leave(at.places.at("0"));
  at.come("a", "4");
  EXPECT_TRUE(at.closed.empty());
  at.come("a", "5");
  at.come("a", "6");
  EXPECT_EQ(at.closed, (std::vector<std::string>{"1", "2"})) << "each goes once";
  EXPECT_EQ(at.door.size(), 6u);
  at.door.close();
  EXPECT_EQ(at.closed.size(), 6u);
}

TEST(Door, OneOfManySourcesIsNotDroppedForAFloodOfOne) {
  Closing at;
  for (int i = 0; i < 5; ++i) at.come("source" + std::to_string(i), "quiet" + std::to_string(i));
  for (int i = 0; i < 100; ++i) at.come("flood", "flood" + std::to_string(i));
  for (const std::string& name : at.closed) EXPECT_EQ(name.find("flood"), 0u) << name;
  EXPECT_EQ(at.closed.size(), 97u);
}

}  // namespace metamer::service
