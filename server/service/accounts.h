#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>

#include "common/wire/peer.h"

namespace metamer::service {

/// One peer, a user of this machine or an address, and what it has of what all share.
struct Account {
  std::string name;               ///< For people: "uid 1000".
  bool owns_server = false;       ///< Connected locally, as the daemon's user or root.
  std::uint64_t asset_bytes = 0;  ///< Held or on their way; kept by AssetStore.
  std::uint64_t last_turn = 0;    ///< When a job of it was taken last; kept by JobQueue.
};
using AccountPtr = std::shared_ptr<Account>;

/// The accounts of all peers that are connected or have a job.
class Accounts {
 public:
  AccountPtr of(const wire::PeerIdentity& peer);

 private:
  std::map<std::string, std::weak_ptr<Account>> accounts_;
};

/// Whether a peer that has `used` may take `more` of something of which `free` are left: it may
/// have at most `peer_share` times what it then leaves. So one peer gets 7/8 of all, a second one
/// 7/8 of the rest, and so on: none takes the last from those who come later (Choudhury and Hahne
/// 1998).
inline constexpr std::uint64_t peer_share = 7;
constexpr bool may_take(std::uint64_t used, std::uint64_t more, std::uint64_t free) {
  return more <= free && used + more <= peer_share * (free - more);
}

}  // namespace metamer::service
