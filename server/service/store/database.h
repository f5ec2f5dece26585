#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

struct sqlite3;
struct sqlite3_stmt;

namespace metamer::service {

/// What SQLite could not do, in its words and with its code (SQLITE_FULL, SQLITE_IOERR, …).
class DatabaseError : public std::runtime_error {
 public:
  DatabaseError(int code, const std::string& what) : std::runtime_error(what), code_(code) {}
  /// The primary code, without its extension.
  int code() const { return code_ & 0xff; }
  /// Another attempt may succeed: the disk is full, or somebody else writes.
  bool may_pass() const;
  /// With room on the disk it would have been done.
  bool is_full() const;
  /// The file, or the disk below it, is not what it should be: no attempt will succeed.
  bool is_broken() const;

 private:
  int code_;
};

/// A statement that is run for one set of values after another. All throw DatabaseError.
class Statement {
 public:
  /// Sets the `index`-th value, from 1.
  Statement& bind(int index, std::int64_t value);
  Statement& bind(int index, double value);
  /// Text; it is copied.
  Statement& bind(int index, std::string_view text);
  /// Bytes; they are copied.
  Statement& bind_bytes(int index, std::string_view bytes);
  Statement& bind_null(int index);

  /// The next row; false when there is none, and the statement may be bound anew.
  bool step();
  /// Runs it to its end.
  void run();
  /// Forgets the rows that were not read.
  void reset();

  // Of the row, from 0.
  std::int64_t integer(int column) const;
  double real(int column) const;
  /// Text or bytes.
  std::string bytes(int column) const;
  bool is_null(int column) const;

 private:
  friend class Database;
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const;
  };
  Statement(sqlite3* database, std::string_view sql);
  void check(int code) const;

  sqlite3* database_;
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

/// One connection to a database file: in WAL mode, each commit on the disk before it returns
/// (synchronous=FULL), foreign keys held. For one thread at a time; a second connection may read
/// and, waiting for up to five seconds, write.
class Database {
 public:
  /// Opens or makes the file, readable by its owner alone. Throws DatabaseError.
  explicit Database(const std::filesystem::path& file);
  /// Opens what is there, to read alone: where nothing can be written, too. Throws DatabaseError.
  static Database to_read(const std::filesystem::path& file);

  Statement prepare(std::string_view sql) { return Statement(connection_.get(), sql); }
  /// Runs statements without values.
  void run(const char* sql);
  /// PRAGMA integrity_check: nothing when all is well, else what it says first.
  std::optional<std::string> damage();

  /// BEGIN IMMEDIATE until commit(); what was done is undone without it.
  class Transaction {
   public:
    explicit Transaction(Database& database);
    ~Transaction();
    Transaction(const Transaction&) = delete;
    Transaction& operator=(const Transaction&) = delete;
    void commit();

   private:
    Database& database_;
    bool open_ = true;
  };

 private:
  struct Close {
    void operator()(sqlite3* connection) const;
  };
  Database(const std::string& name, int flags);
  std::unique_ptr<sqlite3, Close> connection_;
};

}  // namespace metamer::service
