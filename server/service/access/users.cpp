#include "server/service/access/users.h"

#include <openssl/rand.h>

#include <algorithm>
#include <array>

#include "common/digest.h"
#include "server/service/access/permit.h"

namespace metamer::service {

namespace {

constexpr const char* user_columns =
    "users.name, users.role, users.uid, users.share, users.max_jobs, users.max_bytes, "
    "users.max_sessions, users.max_work, users.revoked_at";
constexpr int user_column_count = 9;

std::string select_users(const char* rest) {
  return std::string("SELECT ") + user_columns + " FROM users " + rest;
}

std::optional<std::int64_t> integer_or_none(const Statement& row, int column) {
  if (row.is_null(column)) return std::nullopt;
  return row.integer(column);
}

std::optional<double> real_or_none(const Statement& row, int column) {
  if (row.is_null(column)) return std::nullopt;
  return row.real(column);
}

template <class Value>
void bind_or_null(Statement& statement, int index, const std::optional<Value>& value) {
  if (value) {
    statement.bind(index, *value);
  } else {
    statement.bind_null(index);
  }
}

User read_user(const Statement& row) {
  User user;
  user.name = row.bytes(0);
  user.role = role_of(row.bytes(1));
  if (!row.is_null(2)) user.uid = static_cast<uid_t>(row.integer(2));
  user.share = row.real(3);
  user.max_jobs = integer_or_none(row, 4);
  user.max_bytes = integer_or_none(row, 5);
  user.max_sessions = integer_or_none(row, 6);
  user.max_work = real_or_none(row, 7);
  user.revoked_at = real_or_none(row, 8);
  return user;
}

Token read_token(const Statement& row, int first) {
  return {row.bytes(first), row.real(first + 1), real_or_none(row, first + 2),
          real_or_none(row, first + 3)};
}

std::optional<User> read_one(Statement& statement) {
  if (!statement.step()) return std::nullopt;
  User user = read_user(statement);
  statement.reset();
  return user;
}

User changed(User user, const UserChange& change) {
  if (change.role) user.role = *change.role;
  if (change.uid) user.uid = change.uid;
  if (change.share) user.share = *change.share;
  if (change.max_jobs) user.max_jobs = change.max_jobs;
  if (change.max_bytes) user.max_bytes = change.max_bytes;
  if (change.max_sessions) user.max_sessions = change.max_sessions;
  if (change.max_work) user.max_work = change.max_work;
  user.revoked_at.reset();
  return user;
}

}  // namespace

bool is_user_name(std::string_view name) {
  const auto letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  return !name.empty() && name.size() <= 64 && letter(name[0]) &&
         std::all_of(name.begin(), name.end(), [&](char c) {
           return letter(c) || (c >= '0' && c <= '9') ||
                  std::string_view("._-@").find(c) != std::string_view::npos;
         });
}

std::string token_hash(std::string_view token) { return std::string(to_bytes(sha256(token))); }

bool Users::any() {
  Statement ask = database_.prepare("SELECT 1 FROM users LIMIT 1");
  return ask.step();
}

std::optional<User> Users::find(std::string_view name) {
  Statement ask = database_.prepare(select_users("WHERE name=?"));
  return read_one(ask.bind(1, name));
}

std::optional<User> Users::find_uid(uid_t uid) {
  Statement ask = database_.prepare(select_users("WHERE uid=?"));
  return read_one(ask.bind(1, static_cast<std::int64_t>(uid)));
}

std::optional<TokenOwner> Users::find_token(std::string_view hash) {
  Statement ask = database_.prepare(
      std::string("SELECT ") + user_columns +
      ", label, tokens.created_at, tokens.expires_at, tokens.revoked_at FROM tokens JOIN users ON "
      "tokens.user=users.name WHERE hash=?");
  if (!ask.bind_bytes(1, hash).step()) return std::nullopt;
  return TokenOwner{read_user(ask), read_token(ask, user_column_count)};
}

std::vector<User> Users::list() {
  std::vector<User> users;
  Statement ask = database_.prepare(select_users("ORDER BY name"));
  while (ask.step()) users.push_back(read_user(ask));
  return users;
}

std::vector<Token> Users::tokens(std::string_view user) {
  std::vector<Token> tokens;
  Statement ask = database_.prepare(
      "SELECT label, created_at, expires_at, revoked_at FROM tokens WHERE user=? ORDER BY "
      "created_at");
  ask.bind(1, user);
  while (ask.step()) tokens.push_back(read_token(ask, 0));
  return tokens;
}

Result<User> Users::add(const UserChange& change, double now) {
  if (!is_user_name(change.name))
    return problem(
        "\"" + change.name +
        "\" is no name for a user: 1 to 64 letters, digits, and any of . _ - @, a letter first");
  Database::Transaction transaction(database_);
  const auto known = find(change.name);
  if (!known && !change.role) return problem("a new user needs a role: viewer, submitter or admin");
  if (change.uid) {
    const auto other = find_uid(*change.uid);
    if (other && other->name != change.name)
      return problem("uid " + std::to_string(*change.uid) + " is " + other->name +
                     "'s; revoked users keep theirs");
  }
  User before;
  before.name = change.name;
  const User user = changed(known.value_or(std::move(before)), change);
  Statement put = database_.prepare(
      "INSERT INTO users(name, role, uid, share, max_jobs, max_bytes, max_sessions, created_at, "
      "max_work) VALUES(?1, ?2, ?3, ?4, ?5, ?6, ?7, ?8, ?9) ON CONFLICT(name) DO UPDATE SET "
      "role=?2, "
      "uid=?3, share=?4, max_jobs=?5, max_bytes=?6, max_sessions=?7, max_work=?9, revoked_at=NULL");
  put.bind(1, user.name).bind(2, word(user.role)).bind(4, user.share).bind(8, now);
  bind_or_null(put, 3, user.uid ? std::optional<std::int64_t>(*user.uid) : std::nullopt);
  bind_or_null(put, 5, user.max_jobs);
  bind_or_null(put, 6, user.max_bytes);
  bind_or_null(put, 7, user.max_sessions);
  bind_or_null(put, 9, user.max_work);
  put.run();
  transaction.commit();
  return user;
}

std::string Users::add_token(std::string_view user, std::string_view label,
                             std::optional<double> expires_at, double now) {
  std::array<unsigned char, 32> random{};
  if (RAND_bytes(random.data(), static_cast<int>(random.size())) != 1)
    throw std::runtime_error("the system has no random numbers");
  constexpr const char* digits = "0123456789abcdef";
  std::string token = "mtr_";
  for (const unsigned char byte : random) {
    token += digits[byte >> 4];
    token += digits[byte & 15];
  }
  Statement put = database_.prepare(
      "INSERT INTO tokens(hash, user, label, created_at, expires_at) VALUES(?, ?, ?, ?, ?)");
  put.bind_bytes(1, token_hash(token)).bind(2, user).bind(3, label).bind(4, now);
  bind_or_null(put, 5, expires_at);
  put.run();
  return token;
}

Result<void> Users::revoke(std::string_view name, double now) {
  Database::Transaction transaction(database_);
  const auto user = find(name);
  if (!user) return problem("there is no user " + std::string(name));
  if (user->revoked_at) return problem(user->name + " was revoked before");
  database_.prepare("UPDATE users SET revoked_at=? WHERE name=?").bind(1, now).bind(2, name).run();
  // One who is added again gets new ones.
  database_.prepare("UPDATE tokens SET revoked_at=? WHERE user=? AND revoked_at IS NULL")
      .bind(1, now)
      .bind(2, name)
      .run();
  transaction.commit();
  return {};
}

Result<void> Users::revoke_token(std::string_view name, std::string_view label, double now) {
  Database::Transaction transaction(database_);
  Statement revoke = database_.prepare(
      "UPDATE tokens SET revoked_at=?1 WHERE user=?2 AND label=?3 AND revoked_at IS NULL "
      "RETURNING label");
  revoke.bind(1, now).bind(2, name).bind(3, label);
  if (!revoke.step())
    return problem(std::string(name) + " has no token \"" + std::string(label) +
                   "\" that could be revoked");
  revoke.run();
  transaction.commit();
  return {};
}

}  // namespace metamer::service
