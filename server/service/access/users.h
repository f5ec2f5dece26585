#pragma once

#include <sys/types.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/problem.h"
#include "metamer/v1/session.pb.h"
#include "server/service/store/database.h"

namespace metamer::service {

/// A row of the table of users. A limit that is not set is the server's own.
struct User {
  std::string name;
  v1::Role role = v1::SUBMITTER;
  std::optional<uid_t> uid;  ///< Which user of this machine it is.
  double share = 1;          ///< Its weight where several wait.
  std::optional<std::int64_t> max_jobs, max_bytes, max_sessions;
  std::optional<double> max_work;  ///< Seconds of workers within a day; 0: as many as it wants.
  std::optional<double>
      revoked_at;  ///< Seconds since 1970; it stays, so that its jobs have a name.
};

/// What `metamerd user add` says of one; what is not set stays as it is.
struct UserChange {
  std::string name;
  std::optional<v1::Role> role;
  std::optional<uid_t> uid;
  std::optional<double> share;
  std::optional<std::int64_t> max_jobs, max_bytes, max_sessions;
  std::optional<double> max_work;
};

/// What is known of a token. The token itself is nowhere.
struct Token {
  std::string label;
  double created_at = 0;
  std::optional<double> expires_at, revoked_at;
};

/// What a token's hash leads to, and why it is of no use, for the log.
struct TokenOwner {
  User user;
  Token token;
  bool revoked() const { return token.revoked_at || user.revoked_at; }
  bool expired(double now) const { return token.expires_at && *token.expires_at <= now; }
};

/// The users and their tokens, in the state's database. Several processes may do this at once: the
/// daemon, and `metamerd user`. All throw DatabaseError. Times are seconds since 1970.
class Users {
 public:
  explicit Users(Database& database) : database_(database) {}

  /// Some were added, revoked or not: then only users are let in.
  bool any();
  std::optional<User> find(std::string_view name);
  std::optional<User> find_uid(uid_t uid);
  std::optional<TokenOwner> find_token(std::string_view hash);
  std::vector<User> list();
  std::vector<Token> tokens(std::string_view user);

  /// Makes a user, or changes one, who is then no longer revoked. Errors: no role for a new one, a
  /// name that is none, a uid that is another's.
  Result<User> add(const UserChange& change, double now);
  /// 32 random bytes for a user who is there, to be said by him alone: only their hash is kept.
  std::string add_token(std::string_view user, std::string_view label,
                        std::optional<double> expires_at, double now);
  /// Errors: no such user or token, or it was revoked before.
  Result<void> revoke(std::string_view name, double now);
  Result<void> revoke_token(std::string_view name, std::string_view label, double now);

 private:
  Database& database_;
};

/// What of a token is kept: SHA-256 of its text, 32 bytes. 256 random bits need nothing slower.
std::string token_hash(std::string_view token);

/// 1 to 64 letters, digits and any of ". _ - @", beginning with a letter: names stand in logs, on
/// command lines and in certificates, and none is an address.
bool is_user_name(std::string_view name);

}  // namespace metamer::service
