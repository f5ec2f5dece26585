#include "server/service/access/users.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <set>

#include "../temporary_state.h"
#include "server/service/access/accounts.h"
#include "server/service/ops/folders.h"
#include "server/service/store/schema.h"

namespace metamer::service::test {

namespace {

class UsersTest : public testing::Test {
 protected:
  TemporaryState state_;
  Database database_{state_.database()};
  Users users_{database_};

  void SetUp() override { ASSERT_TRUE(migrate(database_)); }
  static UserChange change(const std::string& name, std::optional<v1::Role> role = {}) {
    UserChange result;
    result.name = name;
    result.role = role;
    return result;
  }
};

}  // namespace

TEST_F(UsersTest, WhatIsAddedIsFoundByNameAndByUid) {
  EXPECT_FALSE(users_.any());
  UserChange ann = change("ann", v1::ADMIN);
  ann.uid = 1001;
  ann.share = 2.5;
  ann.max_jobs = 7;
  ASSERT_TRUE(users_.add(ann, 100));
  EXPECT_TRUE(users_.any());
  const User found = users_.find("ann").value();
  EXPECT_EQ(found.role, v1::ADMIN);
  EXPECT_EQ(found.share, 2.5);
  EXPECT_EQ(found.max_jobs, 7);
  EXPECT_FALSE(found.max_bytes || found.max_sessions || found.revoked_at);
  EXPECT_EQ(users_.find_uid(1001).value().name, "ann");
  EXPECT_FALSE(users_.find("Ann") || users_.find_uid(1002));
}

TEST_F(UsersTest, AddedAgainOnlyWhatIsSaidChanges) {
  UserChange first = change("ann", v1::SUBMITTER);
  first.uid = 1001;
  ASSERT_TRUE(users_.add(first, 100));
  UserChange second = change("ann");
  second.max_sessions = 3;
  second.max_work = 7.5;
  ASSERT_TRUE(users_.add(second, 101));
  const User found = users_.find("ann").value();
  EXPECT_EQ(found.role, v1::SUBMITTER);
  EXPECT_EQ(found.uid, 1001u);
  EXPECT_EQ(found.max_sessions, 3);
  EXPECT_EQ(found.max_work, 7.5);
  EXPECT_EQ(users_.list().size(), 1u);
}

TEST_F(UsersTest, AnAccountHasItsLimitsAndKnowsAdminsWhoAreNotConnected) {
  UserChange ann = change("ann", v1::SUBMITTER);
  ann.max_work = 100;
  ASSERT_TRUE(users_.add(ann, 0));
  ASSERT_TRUE(users_.add(change("root", v1::ADMIN), 0));
  UserChange owner = change("owner", v1::SUBMITTER);
  owner.uid = ::getuid();
  ASSERT_TRUE(users_.add(owner, 0));
  Accounts accounts(&users_);
  EXPECT_EQ(accounts.named("ann")->max_work, 100);
  for (const char* name : {"ann", "192.0.2.7", "uid 4294967294"})
    EXPECT_FALSE(accounts.named(name)->admin) << name;
  for (const std::string name : {"root", "owner", "uid 0"})
    EXPECT_TRUE(accounts.named(name)->admin) << name;
  EXPECT_TRUE(accounts.named("uid " + std::to_string(::getuid()))->admin);
}

TEST_F(UsersTest, WhatIsNoUserIsSaid) {
  EXPECT_NE(users_.add(change("ann"), 0).error().message.find("role"), std::string::npos);
  UserChange ann = change("ann", v1::VIEWER);
  ann.uid = 5;
  ASSERT_TRUE(users_.add(ann, 0));
  UserChange other = change("other", v1::VIEWER);
  other.uid = 5;
  EXPECT_EQ(users_.add(other, 0).error().message, "uid 5 is ann's; revoked users keep theirs");
  // Neither what another kind of identity is called, nor what a log or a shell would misread.
  for (const char* name :
       {"", "uid 5", "127.0.0.1", "::1", "-x", "a b", "a\nb", "ann;", "\xC3\xA4", "a\x1b[2J"})
    EXPECT_FALSE(users_.add(change(name, v1::VIEWER), 0)) << name;
  EXPECT_FALSE(users_.add(change(std::string(65, 'a'), v1::VIEWER), 0));
  EXPECT_TRUE(users_.add(change(std::string(64, 'a'), v1::VIEWER), 0));
}

TEST_F(UsersTest, ATokenIsKnownByItsHashAloneAndStandsNowhere) {
  ASSERT_TRUE(users_.add(change("ann", v1::SUBMITTER), 0));
  std::set<std::string> tokens;
  for (int i = 0; i < 100; ++i) tokens.insert(users_.add_token("ann", "desk", 50.0, 10));
  EXPECT_EQ(tokens.size(), 100u);
  const std::string& token = *tokens.begin();
  EXPECT_EQ(token.substr(0, 4), "mtr_");
  EXPECT_EQ(token.size(), 4u + 64u);
  const auto owner = users_.find_token(token_hash(token));
  ASSERT_TRUE(owner);
  EXPECT_EQ(owner->user.name, "ann");
  EXPECT_EQ(owner->token.label, "desk");
  EXPECT_FALSE(owner->expired(49.9));
  EXPECT_TRUE(owner->expired(50));
  EXPECT_FALSE(users_.find_token(token));
  EXPECT_FALSE(users_.find_token(token_hash(token + "0")));
  database_.run("PRAGMA wal_checkpoint(TRUNCATE)");
  std::ifstream file(state_.database(), std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  EXPECT_NE(bytes.find("desk"), std::string::npos);
  EXPECT_EQ(bytes.find(token.substr(4)), std::string::npos);
}

// FIPS 180-4's own example of SHA-256.
TEST_F(UsersTest, AHashIsSha256) {
  EXPECT_EQ(token_hash("abc").substr(0, 4), "\xba\x78\x16\xbf");
  EXPECT_EQ(token_hash("abc").size(), 32u);
}

TEST_F(UsersTest, WhoIsRevokedStaysAndGetsNewTokensWhenAddedAgain) {
  ASSERT_TRUE(users_.add(change("ann", v1::SUBMITTER), 0));
  const std::string token = users_.add_token("ann", "desk", std::nullopt, 0);
  const std::string other = users_.add_token("ann", "laptop", std::nullopt, 0);
  ASSERT_TRUE(users_.revoke_token("ann", "desk", 5));
  EXPECT_TRUE(users_.find_token(token_hash(token))->revoked());
  EXPECT_FALSE(users_.find_token(token_hash(other))->revoked());
  EXPECT_FALSE(users_.revoke_token("ann", "desk", 6));
  EXPECT_FALSE(users_.revoke_token("ann", "car", 6));

  ASSERT_TRUE(users_.revoke("ann", 7));
  EXPECT_FALSE(users_.revoke("ann", 8));
  EXPECT_FALSE(users_.revoke("nobody", 8));
  EXPECT_TRUE(users_.any());
  EXPECT_EQ(users_.find("ann")->revoked_at, 7.0);
  EXPECT_TRUE(users_.find_token(token_hash(other))->revoked());
  ASSERT_TRUE(users_.add(change("ann"), 9));
  EXPECT_FALSE(users_.find("ann")->revoked_at);
  EXPECT_TRUE(users_.find_token(token_hash(other))->revoked());
  EXPECT_EQ(users_.tokens("ann").size(), 2u);
}

TEST_F(UsersTest, AnotherConnectionSeesWhatThisOneWrites) {
  Database daemon(state_.database());
  Users seen(daemon);
  EXPECT_FALSE(seen.find("ann"));
  ASSERT_TRUE(users_.add(change("ann", v1::VIEWER), 0));
  EXPECT_TRUE(seen.find("ann"));
  ASSERT_TRUE(users_.revoke("ann", 1));
  EXPECT_TRUE(seen.find("ann")->revoked_at);
}

// SQLite's locks are the process's: a file that is opened and closed beside it would give them up,
// and the other process would take the log along when it goes.
TEST_F(UsersTest, AnotherProcessThatComesAndGoesTakesNothingFromTheConnectionsHere) {
  Database second(state_.database());
  const std::string command = std::string(METAMER_BIN "/metamerd user add ann --role viewer") +
                              " --state " + state_.path().string();
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_TRUE(users_.find("ann"));
  ASSERT_TRUE(users_.revoke("ann", 1));
  ASSERT_NE(std::system((command + " --role king 2> /dev/null").c_str()), 0);
  ASSERT_EQ(std::system((command + " --uid 7").c_str()), 0);
  EXPECT_FALSE(users_.find("ann")->revoked_at);
  EXPECT_EQ(Users(second).find("ann")->uid, 7u);
}

// Root's own files would be there when the daemon, which is another user, comes to make its own.
TEST_F(UsersTest, WhatRootMakesIsTheStatesOwners) {
  if (::geteuid() != 0) GTEST_SKIP() << "only root makes files for others";
  const TemporaryFolder folder = TemporaryFolder::make().value();
  constexpr uid_t daemon = 4242;
  ASSERT_EQ(::chown(folder.path().c_str(), daemon, daemon), 0);
  ASSERT_EQ(std::system((METAMER_BIN "/metamerd user add ann --role viewer --state " +
                         folder.path().string())
                            .c_str()),
            0);
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
    struct stat status {};
    ASSERT_EQ(::stat(entry.path().c_str(), &status), 0);
    EXPECT_EQ(status.st_uid, daemon) << entry.path();
    EXPECT_EQ(status.st_gid, daemon) << entry.path();
    ++files;
  }
  EXPECT_GE(files, 1u);
}

TEST_F(UsersTest, AListSaysWhichTokensHaveExpired) {
  ASSERT_TRUE(users_.add(change("ann", v1::VIEWER), 0));
  users_.add_token("ann", "old", 1e9, 0);
  users_.add_token("ann", "young", 1e11, 0);
  FILE* pipe =
      ::popen((METAMER_BIN "/metamerd user list --state " + state_.path().string()).c_str(), "r");
  std::string list;
  for (int byte = std::fgetc(pipe); byte != EOF; byte = std::fgetc(pipe))
    list += static_cast<char>(byte);
  EXPECT_EQ(::pclose(pipe), 0);
  EXPECT_NE(list.find("token \"old\" of 1970-01-01, expired 2001-09-09\n"), std::string::npos)
      << list;
  EXPECT_NE(list.find("token \"young\" of 1970-01-01, expires 5138-11-16\n"), std::string::npos)
      << list;
}

}  // namespace metamer::service::test
