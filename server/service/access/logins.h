#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/wire/peer.h"
#include "server/service/access/identity.h"
#include "server/service/access/login_limit.h"
#include "server/service/access/users.h"
#include "server/service/refusal.h"

namespace metamer::service {

/// What is known of a client before it says a word.
struct Visitor {
  wire::PeerIdentity peer;
  bool encrypted = false;
  std::vector<std::string> certificate_names;  ///< Of a certificate that was verified.
  /// Whose its failures are.
  std::string source() const { return wire::to_string(peer); }
};

/// Decides who somebody is. A token comes first, then a certificate, then what the system says of
/// a Unix socket's other end.
class Logins {
 public:
  /// No `users`: the daemon keeps none. `open`: by TCP without TLS anybody may come, named after
  /// the address.
  Logins(Users* users, bool open) : users_(users), open_(open) {}

  /// Refused: UNAUTHENTICATED, in the same words whatever is wrong with a token (the log says
  /// what); INTERNAL when the database can't be read. A token without TLS from another machine is
  /// refused, too: it is no longer a secret.
  tl::expected<Identity, Refusal> login(const Visitor& visitor, const std::string& token);
  /// Logs that somebody came to nothing before he was let in, and which user he said to be, where
  /// that is known; a flood of these is only counted.
  LoginLimit::Verdict failed(const Visitor& visitor, const std::string& reason,
                             const std::string& user = {});
  /// Whether it would still be let in, and as what it was then. Throws DatabaseError.
  bool stands(const Identity& identity);
  /// Nothing can have been revoked: nobody is kept.
  bool keeps_users() const { return users_ != nullptr; }

 private:
  tl::expected<Identity, Refusal> by_token(const Visitor& visitor, const std::string& token);
  tl::expected<Identity, Refusal> by_certificate(const Visitor& visitor);
  tl::expected<Identity, Refusal> by_credentials(const Visitor& visitor);
  tl::expected<Identity, Refusal> without(const Visitor& visitor);
  tl::unexpected<Refusal> refused(const Visitor& visitor, const char* words,
                                  const std::string& reason, const std::string& user = {});

  Users* users_;
  bool open_;
  LoginLimit limit_;
};

/// Who can change the table of users, and need not stand in it: whose daemon it is, and root.
bool owns_server(uid_t uid);
/// The same, by the name of one who stands in no table: "uid 1000".
bool is_server_owner(std::string_view user);

}  // namespace metamer::service
