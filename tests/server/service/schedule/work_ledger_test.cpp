#include "server/service/schedule/work_ledger.h"

#include <gtest/gtest.h>

namespace metamer::service::test {

namespace {

constexpr double hour = 3600;
constexpr double start = 500'000 * hour;  // a full one

}  // namespace

TEST(WorkLedger, CountsTheHourThatItIsAndThe23Before) {
  WorkLedger ledger;
  ledger.spend("one", 10, start);
  ledger.spend("one", 5, start + hour - 1);
  ledger.spend("one", 1, start + 2 * hour);
  EXPECT_EQ(ledger.spent("one", start + 2 * hour), 16);
  EXPECT_EQ(ledger.spent("one", start + 24 * hour - 1), 16);
  EXPECT_EQ(ledger.spent("one", start + 24 * hour), 1);
  EXPECT_EQ(ledger.spent("one", start + 26 * hour), 0);
  EXPECT_EQ(ledger.spent("other", start), 0);
}

TEST(WorkLedger, SaysWhenThereIsRoomAndThereIsThen) {
  WorkLedger ledger;
  for (int i = 0; i < 24; ++i) ledger.spend("one", 10, start + i * hour + 7);
  const double now = start + 23.5 * hour;
  EXPECT_FALSE(ledger.free_at("one", 240.1, now));
  for (const double most : {240.0, 235.0, 100.0, 10.0, 1e-9}) {
    const auto free = ledger.free_at("one", most, now);
    ASSERT_TRUE(free) << most;
    EXPECT_LT(ledger.spent("one", *free), most);
    EXPECT_GE(ledger.spent("one", *free - 1), most);
  }
  EXPECT_FALSE(ledger.free_at("other", 1e-9, now));
}

TEST(WorkLedger, GoesOnWithWhatWasKeptAndSaysWhatHasChanged) {
  WorkLedger ledger;
  ledger.spend("one", 10, start);
  EXPECT_EQ(ledger.take_changes(start).size(), 1U);
  EXPECT_EQ(ledger.take_changes(start).size(), 0U);
  ledger.spend("one", 2, start + 1);
  ledger.spend("other", 3, start + 1);
  const auto changes = ledger.take_changes(start + 1);
  ASSERT_EQ(changes.size(), 2U);
  EXPECT_EQ(changes[0].seconds, 12) << "of the hour, and not since the last time";

  WorkLedger next;
  next.restore(changes);
  EXPECT_EQ(next.take_changes(start + 1).size(), 0U);
  next.spend("one", 1, start + 2);
  EXPECT_EQ(next.spent("one", start + 2), 13);
  EXPECT_EQ(next.spent("other", start + 2), 3);
}

TEST(WorkLedger, ForgetsWhatIsOlderThanADay) {
  WorkLedger ledger;
  for (int i = 0; i < 1000; ++i) ledger.spend("one", 1, start + i * hour);
  EXPECT_EQ(ledger.take_changes(start + 999 * hour).size(), 24U);
  EXPECT_EQ(WorkLedger::first_hour(start + 999 * hour), 500'000 + 976);
}

}  // namespace metamer::service::test
