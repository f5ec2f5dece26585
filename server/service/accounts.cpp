#include "server/service/accounts.h"

#include <unistd.h>

namespace metamer::service {

AccountPtr Accounts::of(const wire::PeerIdentity& peer) {
  std::erase_if(accounts_, [](const auto& known) { return known.second.expired(); });
  std::weak_ptr<Account>& known = accounts_[wire::to_string(peer)];
  AccountPtr account = known.lock();
  if (account) return account;
  account = std::make_shared<Account>();
  account->name = wire::to_string(peer);
  account->owns_server = peer.user && (*peer.user == ::getuid() || *peer.user == 0);
  known = account;
  return account;
}

}  // namespace metamer::service
