#include "server/service/access/login_limit.h"

#include <gtest/gtest.h>

namespace metamer::service {

namespace {

using namespace std::chrono_literals;
const LoginLimit::Clock::time_point start{1000s};

}  // namespace

TEST(LoginLimit, AFewFailuresAreFreeAndComeBackOneAfterTheOther) {
  LoginLimit limit;
  for (unsigned i = 0; i < LoginLimit::most; ++i) EXPECT_FALSE(limit.failed("a", start).limited);
  EXPECT_TRUE(limit.failed("a", start).limited);
  EXPECT_EQ(limit.failed("a", start).wait, 10s);
  EXPECT_TRUE(limit.failed("a", start + 9s).limited);
  EXPECT_FALSE(limit.failed("a", start + 10s).limited);
  EXPECT_TRUE(limit.failed("a", start + 11s).limited);
  for (unsigned i = 0; i < LoginLimit::most; ++i)
    EXPECT_FALSE(limit.failed("a", start + 1h).limited);
  EXPECT_TRUE(limit.failed("a", start + 1h).limited);
}

TEST(LoginLimit, SourcesDoNotCountForEachOther) {
  LoginLimit limit;
  for (int i = 0; i < 100; ++i) limit.failed("a", start);
  EXPECT_FALSE(limit.failed("b", start).limited);
}

TEST(LoginLimit, WhatWasNotLoggedIsCounted) {
  LoginLimit limit;
  for (unsigned i = 0; i < LoginLimit::most + 7; ++i) limit.failed("a", start);
  EXPECT_EQ(limit.failed("a", start + 1min).unreported, 7u);
  EXPECT_EQ(limit.failed("a", start + 1min).unreported, 0u);
}

TEST(LoginLimit, AsManySourcesAsThereAreAddressesTakeBoundedMemory) {
  LoginLimit limit;
  for (int i = 0; i < 10'000; ++i) limit.failed(std::to_string(i), start + i * 1ms);
  EXPECT_LE(limit.size(), LoginLimit::sources);
  for (unsigned i = 0; i + 1 < LoginLimit::most; ++i)
    EXPECT_FALSE(limit.failed("9999", start + 10s).limited);
  EXPECT_TRUE(limit.failed("9999", start + 10s).limited) << "the newest are remembered";
}

}  // namespace metamer::service
