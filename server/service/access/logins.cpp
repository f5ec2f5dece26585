#include "server/service/access/logins.h"

#include <spdlog/spdlog.h>
#include <unistd.h>

#include "server/service/ops/log.h"
#include "server/service/wall_clock.h"

namespace metamer::service {

namespace {

constexpr const char* bad_token = "this token is not valid here: see metamer login";
constexpr const char* no_credentials = "this server wants to know who asks: see metamer login";

Identity identity_of(const User& user, Identity::Known known) {
  return {user.name, user.role, known, {}, true};
}

}  // namespace

bool owns_server(uid_t uid) { return uid == ::getuid() || uid == 0; }

bool is_server_owner(std::string_view user) {
  wire::PeerIdentity owner, root;
  owner.user = ::getuid();
  root.user = 0;
  return user == wire::to_string(owner) || user == wire::to_string(root);
}

tl::expected<Identity, Refusal> Logins::login(const Visitor& visitor, const std::string& token) {
  try {
    if (!token.empty()) return by_token(visitor, token);
    if (!visitor.certificate_names.empty()) return by_certificate(visitor);
    if (visitor.peer.user) return by_credentials(visitor);
    return without(visitor);
  } catch (const DatabaseError& error) {
    spdlog::error("the table of users can't be read: {}", error.what());
    return refuse(v1::Error::INTERNAL, "the table of users can't be read");
  }
}

LoginLimit::Verdict Logins::failed(const Visitor& visitor, const std::string& reason,
                                   const std::string& user) {
  const auto verdict = limit_.failed(visitor.source(), LoginLimit::Clock::now());
  if (verdict.limited) return verdict;
  if (verdict.unreported > 0)
    log_line(spdlog::level::warn, {.peer = visitor.source()},
             fmt::format("{} further logins failed", verdict.unreported));
  log_line(spdlog::level::warn, {.peer = visitor.source(), .user = user, .reason = reason},
           "a login failed");
  return verdict;
}

/// Takes note, and says to the client no more than it has to know.
tl::unexpected<Refusal> Logins::refused(const Visitor& visitor, const char* words,
                                        const std::string& reason, const std::string& user) {
  const auto verdict = failed(visitor, reason, user);
  if (verdict.limited)
    return refuse(v1::Error::UNAUTHENTICATED, "too many failed logins from " + visitor.source() +
                                                  "; try again in " +
                                                  std::to_string(verdict.wait.count()) + " s");
  return refuse(v1::Error::UNAUTHENTICATED, words);
}

tl::expected<Identity, Refusal> Logins::by_token(const Visitor& visitor, const std::string& token) {
  if (!visitor.encrypted && !visitor.peer.local)
    return refused(visitor, "a token has to be sent by TLS; have this one revoked",
                   "its token came from another machine without TLS");
  if (!users_) return refused(visitor, bad_token, "a token, and no users are kept");
  const std::string hash = token_hash(token);
  const auto owner = users_->find_token(hash);
  if (!owner) return refused(visitor, bad_token, "an unknown token");
  const std::string& user = owner->user.name;
  const std::string named = user + "'s token \"" + owner->token.label + "\"";
  if (owner->revoked()) return refused(visitor, bad_token, named + " is revoked", user);
  if (owner->expired(wall_clock()))
    return refused(visitor, bad_token, named + " has expired", user);
  Identity identity = identity_of(owner->user, Identity::Known::token);
  identity.token_hash = hash;
  return identity;
}

tl::expected<Identity, Refusal> Logins::by_certificate(const Visitor& visitor) {
  for (const std::string& name : visitor.certificate_names) {
    const auto user = users_ ? users_->find(name) : std::nullopt;
    if (user && !user->revoked_at) return identity_of(*user, Identity::Known::certificate);
  }
  return refused(visitor, "this server has no user of your certificate's name",
                 "a certificate of \"" + visitor.certificate_names.front() + "\", who is no user");
}

tl::expected<Identity, Refusal> Logins::by_credentials(const Visitor& visitor) {
  const uid_t uid = *visitor.peer.user;
  const auto user = users_ ? users_->find_uid(uid) : std::nullopt;
  const bool known = user && !user->revoked_at;
  Identity identity{
      wire::to_string(visitor.peer), v1::SUBMITTER, Identity::Known::credentials, {}, known};
  if (known) identity = identity_of(*user, Identity::Known::credentials);
  if (owns_server(uid)) identity.role = v1::ADMIN;
  if (known || owns_server(uid) || !users_ || !users_->any()) return identity;
  return refused(visitor, "this server does not know you: its administrator has to add your user",
                 user ? user->name + " is revoked" : "no user has this uid",
                 user ? user->name : std::string());
}

tl::expected<Identity, Refusal> Logins::without(const Visitor& visitor) {
  if (open_ && !visitor.encrypted)
    return Identity{visitor.source(), v1::SUBMITTER, Identity::Known::open, {}, false};
  return refused(visitor, no_credentials, "no token");
}

bool Logins::stands(const Identity& identity) {
  if (!users_) return true;
  if (!identity.listed)
    return identity.known == Identity::Known::open || identity.is_admin() || !users_->any();
  const auto user = users_->find(identity.user);
  if (!user || user->revoked_at) return false;
  const bool rules =
      identity.known == Identity::Known::credentials && user->uid && owns_server(*user->uid);
  if (identity.role != (rules ? v1::ADMIN : user->role)) return false;
  if (identity.token_hash.empty()) return true;
  const auto owner = users_->find_token(identity.token_hash);
  return owner && !owner->revoked() && !owner->expired(wall_clock());
}

}  // namespace metamer::service
