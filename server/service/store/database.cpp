#include "server/service/store/database.h"

#include <fcntl.h>
#include <sqlite3.h>
#include <unistd.h>

#include <cctype>

namespace metamer::service {

namespace {

/// As long as another connection's commit takes on a slow disk.
constexpr int busy_milliseconds = 5000;

/// As a URI has a path: with %XX for what means something else there.
std::string escaped(const std::string& path) {
  std::string text;
  for (const char c : path) {
    constexpr const char* digits = "0123456789ABCDEF";
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) || c == '/' || c == '.' || c == '-' || c == '_')
      text += c;
    else
      text += {'%', digits[byte >> 4], digits[byte & 15]};
  }
  return text;
}

[[noreturn]] void fail(sqlite3* connection, int code) {
  const char* words = connection ? sqlite3_errmsg(connection) : sqlite3_errstr(code);
  throw DatabaseError(code, words);
}

}  // namespace

bool DatabaseError::may_pass() const {
  return is_full() || code() == SQLITE_BUSY || code() == SQLITE_NOMEM;
}

bool DatabaseError::is_full() const {
  return code() == SQLITE_FULL || code_ == SQLITE_IOERR_SHMSIZE;
}

bool DatabaseError::is_broken() const {
  return (code() == SQLITE_IOERR && !is_full()) || code() == SQLITE_CORRUPT ||
         code() == SQLITE_NOTADB || code() == SQLITE_READONLY || code() == SQLITE_CANTOPEN;
}

void Statement::Finalize::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }

Statement::Statement(sqlite3* database, std::string_view sql) : database_(database) {
  sqlite3_stmt* statement = nullptr;
  check(
      sqlite3_prepare_v2(database, sql.data(), static_cast<int>(sql.size()), &statement, nullptr));
  statement_.reset(statement);
}

void Statement::check(int code) const {
  if (code != SQLITE_OK) fail(database_, code);
}

Statement& Statement::bind(int index, std::int64_t value) {
  check(sqlite3_bind_int64(statement_.get(), index, value));
  return *this;
}

Statement& Statement::bind(int index, double value) {
  check(sqlite3_bind_double(statement_.get(), index, value));
  return *this;
}

Statement& Statement::bind(int index, std::string_view text) {
  check(sqlite3_bind_text64(statement_.get(), index, text.data() ? text.data() : "", text.size(),
                            SQLITE_TRANSIENT, SQLITE_UTF8));
  return *this;
}

Statement& Statement::bind_bytes(int index, std::string_view bytes) {
  check(sqlite3_bind_blob64(statement_.get(), index, bytes.data() ? bytes.data() : "", bytes.size(),
                            SQLITE_TRANSIENT));
  return *this;
}

Statement& Statement::bind_null(int index) {
  check(sqlite3_bind_null(statement_.get(), index));
  return *this;
}

bool Statement::step() {
  const int code = sqlite3_step(statement_.get());
  if (code == SQLITE_ROW) return true;
  if (code == SQLITE_DONE) {
    reset();
    return false;
  }
  const std::string words = sqlite3_errmsg(database_);
  reset();
  throw DatabaseError(code, words);
}

void Statement::run() {
  while (step()) {
  }
}

void Statement::reset() { sqlite3_reset(statement_.get()); }

std::int64_t Statement::integer(int column) const {
  return sqlite3_column_int64(statement_.get(), column);
}

double Statement::real(int column) const { return sqlite3_column_double(statement_.get(), column); }

std::string Statement::bytes(int column) const {
  const void* data = sqlite3_column_blob(statement_.get(), column);
  const int size = sqlite3_column_bytes(statement_.get(), column);
  return data ? std::string(static_cast<const char*>(data), static_cast<std::size_t>(size)) : "";
}

bool Statement::is_null(int column) const {
  return sqlite3_column_type(statement_.get(), column) == SQLITE_NULL;
}

void Database::Close::operator()(sqlite3* connection) const { sqlite3_close_v2(connection); }

Database::Database(const std::filesystem::path& file) {
  // Made first, since SQLite would let the umask decide who may read it; -wal and -shm follow it.
  // One that is there is not opened: closing it would take the locks of this process's other
  // connections (fcntl(2)), and another process would then take the log away from under them.
  const int fd = ::open(file.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (fd >= 0) ::close(fd);
  *this = Database(file.string(), SQLITE_OPEN_READWRITE);
  run("PRAGMA journal_mode=WAL; PRAGMA synchronous=FULL; PRAGMA foreign_keys=ON");
}

Database::Database(const std::string& name, int flags) {
  sqlite3* connection = nullptr;
  const int code = sqlite3_open_v2(name.c_str(), &connection, flags | SQLITE_OPEN_NOMUTEX, nullptr);
  connection_.reset(connection);
  if (code != SQLITE_OK) fail(connection, code);
  sqlite3_extended_result_codes(connection, 1);
  sqlite3_busy_timeout(connection, busy_milliseconds);
}

Database Database::to_read(const std::filesystem::path& file) {
  constexpr const char* touch = "SELECT 1 FROM sqlite_schema LIMIT 1";
  try {
    Database shared(file.string(), SQLITE_OPEN_READONLY);
    shared.run(touch);
    return shared;
  } catch (const DatabaseError& error) {
    if (!error.is_broken() && !error.is_full()) throw;
    // No daemon has made the index of its log, and there may be no room for one, or no leave.
  }
  std::error_code error;
  const auto log = std::filesystem::file_size(file.string() + "-wal", error);
  if (error || log == 0) {
    Database still("file:" + escaped(file.string()) + "?immutable=1",
                   SQLITE_OPEN_READONLY | SQLITE_OPEN_URI);
    still.run(touch);
    return still;
  }
  // With an index of its own, in memory, and without writing the log's pages back.
  Database alone(file.string(), SQLITE_OPEN_READWRITE);
  sqlite3_db_config(alone.connection_.get(), SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
  alone.run("PRAGMA locking_mode=EXCLUSIVE");
  alone.run(touch);
  return alone;
}

void Database::run(const char* sql) {
  const int code = sqlite3_exec(connection_.get(), sql, nullptr, nullptr, nullptr);
  if (code != SQLITE_OK) fail(connection_.get(), code);
}

std::optional<std::string> Database::damage() {
  Statement check = prepare("PRAGMA integrity_check(1)");
  if (!check.step()) return std::nullopt;
  std::string words = check.bytes(0);
  if (words == "ok") return std::nullopt;
  return words;
}

Database::Transaction::Transaction(Database& database) : database_(database) {
  database_.run("BEGIN IMMEDIATE");
}

Database::Transaction::~Transaction() {
  if (open_) sqlite3_exec(database_.connection_.get(), "ROLLBACK", nullptr, nullptr, nullptr);
}

void Database::Transaction::commit() {
  database_.run("COMMIT");
  open_ = false;
}

}  // namespace metamer::service
