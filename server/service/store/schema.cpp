#include "server/service/store/schema.h"

#include <openssl/rand.h>

#include <array>

namespace metamer::service {

namespace {

/// "Mtmr": SQLite's own mark for whose file it is.
constexpr std::int64_t application_id = 0x4d746d72;

/// Each brings the tables from the version before it (its place here) to its own. What has been
/// released is never changed: a new one is added.
constexpr std::array<const char*, 1> steps{
    // Times are seconds since 1970. A job's record is in record_row.h; what
    // stands beside it is for whoever looks into the database.
    R"(
CREATE TABLE meta(key TEXT PRIMARY KEY, value BLOB) STRICT;
CREATE TABLE users(
  name TEXT PRIMARY KEY,
  role TEXT NOT NULL CHECK(role IN ('viewer', 'submitter', 'admin')),
  uid INTEGER UNIQUE,
  share REAL NOT NULL DEFAULT 1,
  max_jobs INTEGER,
  max_bytes INTEGER,
  max_sessions INTEGER,
  max_work REAL,
  created_at REAL NOT NULL,
  revoked_at REAL) STRICT;
CREATE TABLE tokens(
  hash BLOB PRIMARY KEY,
  user TEXT NOT NULL REFERENCES users(name),
  label TEXT NOT NULL,
  created_at REAL NOT NULL,
  expires_at REAL,
  revoked_at REAL) STRICT;
CREATE TABLE jobs(
  id INTEGER PRIMARY KEY AUTOINCREMENT,
  user TEXT NOT NULL,
  state INTEGER NOT NULL,
  ended_at REAL,
  record BLOB NOT NULL) STRICT;
CREATE TABLE leads(
  backend INTEGER NOT NULL,
  user TEXT NOT NULL,
  seconds REAL NOT NULL,
  PRIMARY KEY(backend, user)) STRICT, WITHOUT ROWID;
CREATE TABLE work(
  user TEXT NOT NULL,
  hour INTEGER NOT NULL,
  seconds REAL NOT NULL,
  PRIMARY KEY(user, hour)) STRICT, WITHOUT ROWID;
)"};

std::int64_t pragma(Database& database, const char* name) {
  Statement ask = database.prepare(std::string("PRAGMA ") + name);
  ask.step();
  return ask.integer(0);
}

}  // namespace

const int schema_version = static_cast<int>(steps.size());

namespace {

Result<void> check_owner(Database& database, std::int64_t version) {
  const std::int64_t owner = pragma(database, "application_id");
  if (owner != application_id && (owner != 0 || version != 0))
    return problem("the state's database is another program's");
  if (version > schema_version) {
    return problem("the state's database is of version " + std::to_string(version) +
                   ", this metamerd writes " + std::to_string(schema_version) +
                   ": start the newer metamerd");
  }
  return {};
}

}  // namespace

Result<void> check_version(Database& database) {
  const std::int64_t version = pragma(database, "user_version");
  if (auto ours = check_owner(database, version); !ours) return ours;
  if (version == schema_version) return {};
  return problem("the state's database is of version " + std::to_string(version) +
                 ": this metamerd brings it up to date when it starts");
}

Result<void> migrate(Database& database) {
  Database::Transaction transaction(database);
  const std::int64_t version = pragma(database, "user_version");
  if (auto ours = check_owner(database, version); !ours) return ours;
  for (auto step = static_cast<std::size_t>(version); step < steps.size(); ++step)
    database.run(steps[step]);
  database.run(("PRAGMA user_version=" + std::to_string(schema_version)).c_str());
  database.run(("PRAGMA application_id=" + std::to_string(application_id)).c_str());
  transaction.commit();
  return {};
}

std::string server_id(Database& database) {
  Statement find = database.prepare("SELECT value FROM meta WHERE key='server_id'");
  if (find.step()) return find.bytes(0);
  std::array<unsigned char, 16> random{};
  if (RAND_bytes(random.data(), static_cast<int>(random.size())) != 1)
    throw std::runtime_error("the system has no random numbers");
  std::string id(random.begin(), random.end());
  database.prepare("INSERT INTO meta VALUES('server_id', ?)").bind_bytes(1, id).run();
  return id;
}

}  // namespace metamer::service
