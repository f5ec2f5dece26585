// Who is let in, and as whom.

#include "server/service/access/logins.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include "../client.h"
#include "../daemon.h"
#include "../temporary_state.h"
#include "server/service/store/schema.h"

namespace metamer::service::test {

namespace {

constexpr uid_t stranger_uid = 4'000'000;

Visitor local_user(uid_t uid) {
  Visitor visitor;
  visitor.peer.user = uid;
  visitor.peer.local = true;
  return visitor;
}

Visitor tcp(const std::string& address, bool encrypted = false) {
  Visitor visitor;
  visitor.peer.address = address;
  visitor.peer.local = address == "127.0.0.1";
  visitor.encrypted = encrypted;
  return visitor;
}

class LoginsTest : public testing::Test {
 protected:
  TemporaryState state_;
  Database database_{state_.database()};
  Users users_{database_};
  Logins logins_{&users_, false};

  void SetUp() override { ASSERT_TRUE(migrate(database_)); }
  void add(const std::string& name, v1::Role role, std::optional<uid_t> uid = {}) {
    UserChange change;
    change.name = name;
    change.role = role;
    change.uid = uid;
    ASSERT_TRUE(users_.add(change, 0));
  }
  /// What a login that is refused says.
  std::string refusal(const Visitor& visitor, const std::string& token = {}) {
    const auto identity = logins_.login(visitor, token);
    EXPECT_FALSE(identity);
    if (identity) return "let in as " + identity->user;
    EXPECT_EQ(identity.error().code, v1::Error::UNAUTHENTICATED);
    return identity.error().message;
  }
};

}  // namespace

TEST_F(LoginsTest, WithoutUsersWhoeverReachesTheSocketSubmitsAndTheOwnerRules) {
  const auto stranger = logins_.login(local_user(stranger_uid), "").value();
  EXPECT_EQ(stranger.user, "uid 4000000");
  EXPECT_EQ(stranger.role, v1::SUBMITTER);
  for (const uid_t owner : {::getuid(), uid_t{0}})
    EXPECT_EQ(logins_.login(local_user(owner), "").value().role, v1::ADMIN);
  EXPECT_EQ(Logins(nullptr, false).login(local_user(stranger_uid), "").value().role, v1::SUBMITTER);
}

TEST_F(LoginsTest, WithUsersOnlyTheseAndTheOwnerComeIn) {
  add("ann", v1::VIEWER, 4'000'001);
  const auto ann = logins_.login(local_user(4'000'001), "").value();
  EXPECT_EQ(ann.user, "ann");
  EXPECT_EQ(ann.role, v1::VIEWER);
  EXPECT_TRUE(logins_.login(local_user(::getuid()), ""));
  EXPECT_EQ(refusal(local_user(stranger_uid)),
            "this server does not know you: its administrator has to add your user");
  ASSERT_TRUE(users_.revoke("ann", 1));
  refusal(local_user(4'000'001));
  EXPECT_FALSE(logins_.stands(ann));
}

TEST_F(LoginsTest, WrongExpiredRevokedAndForeignTokensAreRefusedInTheSameWords) {
  add("ann", v1::SUBMITTER);
  add("bob", v1::SUBMITTER);
  const std::string good = users_.add_token("ann", "desk", std::nullopt, 0);
  const std::string expired = users_.add_token("ann", "old", 1.0, 0);
  const std::string revoked = users_.add_token("ann", "lost", std::nullopt, 0);
  const std::string gone = users_.add_token("bob", "desk", std::nullopt, 0);
  ASSERT_TRUE(users_.revoke_token("ann", "lost", 1));
  ASSERT_TRUE(users_.revoke("bob", 1));
  const std::string foreign = "mtr_" + std::string(64, 'a');
  int source = 0;
  for (const std::string& token :
       {expired, revoked, gone, foreign, std::string("x"), good + " ", std::string(4000, 'x')})
    EXPECT_EQ(refusal(tcp("192.0.2." + std::to_string(++source), true), token),
              "this token is not valid here: see metamer login");
  EXPECT_EQ(logins_.login(tcp("192.0.2.1", true), good).value().user, "ann");
}

TEST_F(LoginsTest, ATokenComesBeforeWhatTheSystemSays) {
  add("ann", v1::VIEWER);
  const std::string token = users_.add_token("ann", "desk", std::nullopt, 0);
  EXPECT_EQ(logins_.login(local_user(::getuid()), token).value().user, "ann");
  refusal(local_user(::getuid()), "wrong");
}

TEST_F(LoginsTest, ATokenThatAnybodyCouldReadOnItsWayIsRefused) {
  add("ann", v1::VIEWER);
  const std::string token = users_.add_token("ann", "desk", std::nullopt, 0);
  EXPECT_EQ(refusal(tcp("192.0.2.1"), token),
            "a token has to be sent by TLS; have this one revoked");
  EXPECT_TRUE(logins_.login(tcp("127.0.0.1"), token));
  EXPECT_TRUE(logins_.login(tcp("192.0.2.1", true), token));
}

TEST_F(LoginsTest, AnOpenServerTakesAnybodyByPlainTcpAndNobodyByTls) {
  EXPECT_EQ(refusal(tcp("127.0.0.1")), "this server wants to know who asks: see metamer login");
  Logins open(&users_, true);
  const auto identity = open.login(tcp("127.0.0.1"), "").value();
  EXPECT_EQ(identity.user, "127.0.0.1");
  EXPECT_EQ(identity.role, v1::SUBMITTER);
  EXPECT_FALSE(open.login(tcp("127.0.0.1", true), ""));
  EXPECT_TRUE(open.stands(identity));
}

TEST_F(LoginsTest, ACertificateNamesAUser) {
  add("ann", v1::ADMIN);
  Visitor visitor = tcp("192.0.2.1", true);
  visitor.certificate_names = {"desk.example.org", "ann"};
  const auto ann = logins_.login(visitor, "").value();
  EXPECT_EQ(ann.user, "ann");
  EXPECT_EQ(ann.role, v1::ADMIN);
  visitor.certificate_names = {"root"};
  EXPECT_EQ(refusal(visitor), "this server has no user of your certificate's name");
  ASSERT_TRUE(users_.revoke("ann", 1));
  EXPECT_FALSE(logins_.stands(ann));
}

TEST_F(LoginsTest, WhoFailsTooOftenIsToldSoAndAValidTokenStillComesIn) {
  add("ann", v1::VIEWER);
  const std::string token = users_.add_token("ann", "desk", std::nullopt, 0);
  for (unsigned i = 0; i < LoginLimit::most; ++i) refusal(tcp("127.0.0.1"), "wrong");
  EXPECT_EQ(refusal(tcp("127.0.0.1"), "wrong").find("too many failed logins from 127.0.0.1"), 0u);
  EXPECT_TRUE(logins_.login(tcp("127.0.0.1"), token)) << "others share the address";
}

TEST_F(LoginsTest, WhatSomebodyCameInWithStandsUntilItIsRevokedOrHisRoleChanges) {
  add("ann", v1::SUBMITTER);
  const std::string token = users_.add_token("ann", "desk", std::nullopt, 0);
  const std::string other = users_.add_token("ann", "laptop", std::nullopt, 0);
  const auto desk = logins_.login(tcp("127.0.0.1"), token).value();
  const auto laptop = logins_.login(tcp("127.0.0.1"), other).value();
  EXPECT_TRUE(logins_.stands(desk));
  ASSERT_TRUE(users_.revoke_token("ann", "desk", 1));
  EXPECT_FALSE(logins_.stands(desk));
  EXPECT_TRUE(logins_.stands(laptop));
  add("ann", v1::VIEWER);
  EXPECT_FALSE(logins_.stands(laptop));
}

namespace {

void keep_users(ServiceOptions& options, const TemporaryState& state) {
  options.state = state.path();
  options.open = false;
  options.patience.recheck = std::chrono::milliseconds(20);
}

}  // namespace

TEST(Login, ARefusedOneIsToldWhyAndClosed) {
  TemporaryState state;
  Daemon daemon([&](ServiceOptions& options) { keep_users(options, state); });
  for (const char* token : {"", "mtr_wrong"}) {
    Client client(daemon.port());
    const v1::Envelope answer = client.log_in(token);
    EXPECT_EQ(answer.error().code(), v1::Error::UNAUTHENTICATED) << answer.ShortDebugString();
    EXPECT_TRUE(client.closed_by_server());
  }
  EXPECT_EQ(Client(daemon.socket()).hello().role(), v1::ADMIN);
}

TEST(Login, WhoIsRevokedIsOutWithinSecondsAndHisJobGoesOn) {
  TemporaryState state;
  Daemon daemon([&](ServiceOptions& options) { keep_users(options, state); });
  Database database(state.database());
  Users users(database);
  UserChange ann;
  ann.name = "ann";
  ann.role = v1::SUBMITTER;
  ASSERT_TRUE(users.add(ann, 0));
  const std::string token = users.add_token("ann", "desk", std::nullopt, 0);
  Client client(daemon.port());
  EXPECT_EQ(client.hello(token).user(), "ann");
  const auto job = client.submit("gate 0");
  ASSERT_TRUE(users.revoke("ann", 1));
  const auto last = client.receive();
  ASSERT_TRUE(last);
  EXPECT_EQ(last->error().code(), v1::Error::UNAUTHENTICATED);
  EXPECT_TRUE(client.closed_by_server());
  Client again(daemon.port());
  EXPECT_EQ(again.log_in(token).error().code(), v1::Error::UNAUTHENTICATED);
  Client owner(daemon.socket());
  owner.hello();
  EXPECT_EQ(owner.summary(job).user(), "ann");
  EXPECT_NE(owner.summary(job).state(), v1::CANCELLED);
}

TEST(Login, AUsersLimitsAreHeldAtOnce) {
  TemporaryState state;
  Daemon daemon([&](ServiceOptions& options) { keep_users(options, state); });
  Database database(state.database());
  Users users(database);
  UserChange ann;
  ann.name = "ann";
  ann.role = v1::SUBMITTER;
  ann.max_jobs = 1;
  ann.max_bytes = 100;
  ann.max_sessions = 2;
  ASSERT_TRUE(users.add(ann, 0));
  const std::string token = users.add_token("ann", "desk", std::nullopt, 0);
  Client first(daemon.port());
  first.hello(token);
  Client second(daemon.port());
  second.hello(token);
  Client third(daemon.port());
  EXPECT_EQ(third.log_in(token).error().code(), v1::Error::LIMIT);
  EXPECT_TRUE(third.closed_by_server());

  first.submit("gate 0");
  v1::Envelope submit;
  submit.mutable_submit()->set_scene_sha256(first.upload({"picture 8 8 8"})[0]);
  EXPECT_EQ(first.ask(submit).error().message(), "ann may have 1 jobs that have not ended");
  v1::Envelope chunk;
  chunk.mutable_asset_chunk()->set_sha256(std::string(32, 'x'));
  chunk.mutable_asset_chunk()->set_size(1000);
  chunk.mutable_asset_chunk()->set_data("x");
  EXPECT_EQ(first.ask(chunk).error().message(), "ann may have 100 bytes of assets");
  ann.max_sessions = 3;
  ASSERT_TRUE(users.add(ann, 0));
  Client(daemon.port()).hello(token);
}

}  // namespace metamer::service::test
