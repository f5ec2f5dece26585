#pragma once

#include <sys/types.h>

#include <optional>
#include <string>

#include "common/wire/endpoint.h"

namespace metamer::wire {

/// Who is at the other end of a connection, as the system tells it.
struct PeerIdentity {
  /// Of a Unix socket: who connected, or at the connecting end who listens.
  std::optional<uid_t> user;
  std::optional<pid_t> process;  ///< The same end's; who can't be seen from here has none.
  /// Of TCP: the address without its port; of IPv6 its first 64 bits, the part that a provider
  /// gives out as one.
  std::string address;
  bool local = false;  ///< Of this machine: a Unix socket, or an address of the loopback.

  bool operator==(const PeerIdentity&) const = default;
};

/// Neither is known where the connection is gone already.
PeerIdentity peer_of(Socket& socket);
/// "uid 1000", "10.0.0.2", "2001:db8::/64"
std::string to_string(const PeerIdentity& peer);

}  // namespace metamer::wire
