#include "server/service/store/schema.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "../temporary_state.h"

namespace metamer::service {
namespace {

using test::TemporaryState;

TEST(Schema, IsMadeOnceAndKeepsItsServersId) {
  const TemporaryState state;
  std::string first;
  {
    Database database(state.database());
    ASSERT_TRUE(migrate(database));
    first = server_id(database);
    EXPECT_EQ(first.size(), 16u);
    database.run("INSERT INTO users(name, role, created_at) VALUES('anna', 'admin', 1)");
  }
  Database database(state.database());
  ASSERT_TRUE(migrate(database));
  EXPECT_EQ(server_id(database), first);
  Statement users = database.prepare("SELECT name FROM users");
  ASSERT_TRUE(users.step());
  EXPECT_EQ(users.bytes(0), "anna");
  EXPECT_EQ(database.damage(), std::nullopt);
}

TEST(Schema, ALaterOneIsRefusedAndLeftAsItIs) {
  const TemporaryState state;
  Database database(state.database());
  ASSERT_TRUE(migrate(database));
  database.run(("PRAGMA user_version=" + std::to_string(schema_version + 1)).c_str());
  const auto migrated = migrate(database);
  ASSERT_FALSE(migrated);
  EXPECT_NE(migrated.error().message.find("start the newer metamerd"), std::string::npos);
  Statement version = database.prepare("PRAGMA user_version");
  ASSERT_TRUE(version.step());
  EXPECT_EQ(version.integer(0), schema_version + 1);
}

TEST(Schema, AnotherProgramsDatabaseIsRefused) {
  const TemporaryState state;
  Database database(state.database());
  database.run("PRAGMA application_id=7; PRAGMA user_version=1");
  EXPECT_FALSE(migrate(database));
}

TEST(Database, IsReadableByItsOwnerAlone) {
  const TemporaryState state;
  Database database(state.database());
  ASSERT_TRUE(migrate(database));
  for (const char* suffix : {"", "-wal", "-shm"}) {
    struct stat status {};
    ASSERT_EQ(::stat((state.database().string() + suffix).c_str(), &status), 0) << suffix;
    EXPECT_EQ(status.st_mode & 0777u, 0600u) << suffix;
  }
}

TEST(Database, WhatIsNoDatabaseIsATypedError) {
  const TemporaryState state;
  std::ofstream(state.database()) << std::string(4096, 'x');
  EXPECT_THROW(Database{state.database()}, DatabaseError);
}

TEST(Database, ATransactionThatIsNotCommittedIsUndone) {
  const TemporaryState state;
  Database database(state.database());
  ASSERT_TRUE(migrate(database));
  {
    Database::Transaction transaction(database);
    database.run("INSERT INTO meta VALUES('a', x'00')");
  }
  EXPECT_FALSE(database.prepare("SELECT 1 FROM meta WHERE key='a'").step());
}

}  // namespace
}  // namespace metamer::service
