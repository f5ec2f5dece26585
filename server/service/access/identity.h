#pragma once

#include <string>
#include <string_view>

#include "metamer/v1/session.pb.h"

namespace metamer::service {

/// Who asks, once a session has begun.
struct Identity {
  /// How it is known.
  enum class Known {
    credentials,  ///< The system says which user of this machine it is (SO_PEERCRED).
    token,        ///< It has said a user's token.
    certificate,  ///< It has shown a certificate that names a user.
    open,         ///< Not at all: the server is open to whoever reaches it.
  };

  std::string user;  ///< Its name in the table of users; else "uid 1000", or an address.
  v1::Role role = v1::VIEWER;
  Known known = Known::open;
  std::string token_hash;  ///< Of the token that was said: it may be revoked later.
  bool listed = false;     ///< It is in the table of users.

  bool is_admin() const { return role == v1::ADMIN; }
  /// A stranger's job or view does not exist for it.
  bool sees(std::string_view owner) const { return is_admin() || owner == user; }
};

}  // namespace metamer::service
