#include "server/service/store/journal.h"

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <system_error>

#include "../temporary_state.h"
#include "server/service/store/schema.h"

namespace metamer::service {
namespace {

struct Journals : testing::Test {
  test::TemporaryState state;
  asio::io_context loop;
  std::unique_ptr<Journal> journal = open();

  std::unique_ptr<Journal> open() {
    auto database = std::make_unique<Database>(state.database());
    EXPECT_TRUE(migrate(*database));
    return std::make_unique<Journal>(loop.get_executor(), std::move(database));
  }
  static Journal::Work insert(const std::string& key) {
    return [key](Database& database) {
      Statement put = database.prepare("INSERT INTO meta VALUES(?, NULL)");
      put.bind(1, key).run();
    };
  }
  std::vector<std::string> keys() {
    Database database(state.database());
    Statement all = database.prepare("SELECT key FROM meta ORDER BY rowid");
    std::vector<std::string> keys;
    while (all.step()) keys.push_back(all.bytes(0));
    return keys;
  }
  /// Runs the loop until `done` holds.
  template <class Done>
  void run_until(Done done) {
    const auto work = asio::make_work_guard(loop);
    loop.restart();
    while (!done()) loop.run_one();
  }
};

TEST_F(Journals, WhatIsDoneIsThereForAnotherConnection) {
  bool done = false;
  journal->post(insert("a"), [&](const auto& trouble) {
    EXPECT_FALSE(trouble);
    EXPECT_EQ(keys(), std::vector<std::string>{"a"});
    done = true;
  });
  run_until([&] { return done; });
}

TEST_F(Journals, KeepTheOrderInWhichTheyWereAsked) {
  std::vector<int> order;
  std::vector<std::string> expected;
  for (int i = 0; i < 500; ++i) {
    expected.push_back(std::to_string(i));
    journal->post(insert(expected.back()), [&order, i](const auto&) { order.push_back(i); });
  }
  run_until([&] { return order.size() == 500; });
  EXPECT_TRUE(std::is_sorted(order.begin(), order.end()));
  EXPECT_EQ(keys(), expected);
  EXPECT_LT(journal->commits(), 500u) << "what gathers goes into one transaction";
}

TEST_F(Journals, OneThatFailsFailsAlone) {
  std::vector<bool> failed;
  const auto note = [&](const std::optional<StoreTrouble>& trouble) {
    failed.push_back(trouble.has_value());
  };
  for (int i = 0; i < 20; ++i) {
    if (i % 5 == 3)
      journal->post([](Database&) { throw std::system_error(ENOSPC, std::generic_category()); },
                    note);
    else
      journal->post(insert(std::to_string(i)), note);
  }
  run_until([&] { return failed.size() == 20; });
  for (std::size_t i = 0; i < 20; ++i) EXPECT_EQ(failed[i], i % 5 == 3) << i;
  EXPECT_EQ(keys().size(), 16u);
}

TEST_F(Journals, AFullDiskMayPassAndABrokenOneDoesNot) {
  std::vector<std::optional<StoreTrouble>> seen;
  const auto note = [&](const std::optional<StoreTrouble>& trouble) { seen.push_back(trouble); };
  journal->post([](Database&) { throw DatabaseError(SQLITE_FULL, "full"); }, note);
  run_until([&] { return seen.size() == 1; });
  ASSERT_TRUE(seen[0]);
  EXPECT_TRUE(seen[0]->may_pass);
  journal->post(insert("after"), note);
  run_until([&] { return seen.size() == 2; });
  EXPECT_FALSE(seen[1]);

  journal->post(insert("after"), note);  // breaks the table's rule, which is nobody's disk
  journal->post(insert("later"), note);
  run_until([&] { return seen.size() == 4; });
  EXPECT_TRUE(seen[2]);
  EXPECT_FALSE(seen[3]);

  journal->post([](Database&) { throw DatabaseError(SQLITE_IOERR_FSYNC, "sync"); }, note);
  journal->post(insert("never"), note);
  run_until([&] { return seen.size() == 6; });
  for (const std::size_t i : {4u, 5u}) {
    ASSERT_TRUE(seen[i]) << i;
    EXPECT_FALSE(seen[i]->may_pass);
    EXPECT_EQ(seen[i]->message, "sync");
  }
  EXPECT_EQ(keys(), (std::vector<std::string>{"after", "later"}));
}

TEST_F(Journals, WhatWasPostedIsCarriedOutBeforeTheEnd) {
  for (int i = 0; i < 100; ++i) journal->post(insert(std::to_string(i)));
  journal.reset();
  EXPECT_EQ(keys().size(), 100u);
}

TEST_F(Journals, OneWhoWaitsMayGo) {
  auto waiting = std::make_unique<asio::cancellation_signal>();
  asio::co_spawn(
      loop, [&]() -> asio::awaitable<void> { (void)co_await journal->carry_out(insert("a")); },
      asio::bind_cancellation_slot(waiting->slot(), asio::detached));
  loop.run_one();
  waiting->emit(asio::cancellation_type::terminal);
  bool done = false;
  journal->post({}, [&](const auto&) { done = true; });
  run_until([&] { return done; });
  EXPECT_EQ(keys(), std::vector<std::string>{"a"});
}

}  // namespace
}  // namespace metamer::service
