#include "server/service/access/known_assets.h"

#include <algorithm>

namespace metamer::service {

void KnownAssets::add(const std::string& user, const Digest& digest) {
  User& known = users_[user];
  if (!known.digests.insert(digest).second) return;
  known.order.push_back(digest);
  if (++size_ > limit_) drop_oldest();
}

bool KnownAssets::knows(const std::string& user, const Digest& digest) const {
  const auto found = users_.find(user);
  return found != users_.end() && found->second.digests.contains(digest);
}

void KnownAssets::forget(const std::string& user, const Digest& digest) {
  const auto found = users_.find(user);
  if (found == users_.end() || found->second.digests.erase(digest) == 0) return;
  std::erase(found->second.order, digest);
  --size_;
  if (found->second.digests.empty()) users_.erase(found);
}

void KnownAssets::drop_oldest() {
  const auto greediest =
      std::max_element(users_.begin(), users_.end(), [](const auto& a, const auto& b) {
        return a.second.digests.size() < b.second.digests.size();
      });
  forget(greediest->first, Digest(greediest->second.order.front()));
}

}  // namespace metamer::service
