#include "server/service/schedule/retention.h"

#include <cassert>

namespace metamer::service {

std::uint64_t Retention::amount(const User& user, Measure measure) {
  return measure == Measure::jobs ? user.entries.size() : user.bytes;
}

std::uint64_t Retention::total(Measure measure) const {
  return measure == Measure::jobs ? jobs_ : bytes_;
}

void Retention::add(std::string_view user, double share, const Entry& entry) {
  assert(share > 0);
  auto known = users_.find(user);
  if (known == users_.end()) known = users_.emplace(user, User{}).first;
  known->second.share = share;
  known->second.entries.push_back(entry);
  known->second.bytes += entry.bytes;
  ++jobs_;
  bytes_ += entry.bytes;
}

std::uint64_t Retention::take_oldest(Users::iterator user) {
  const Entry oldest = user->second.entries.front();
  user->second.entries.pop_front();
  user->second.bytes -= oldest.bytes;
  --jobs_;
  bytes_ -= oldest.bytes;
  if (user->second.entries.empty()) users_.erase(user);
  return oldest.job;
}

std::optional<std::uint64_t> Retention::take_beyond(Measure measure, std::uint64_t most,
                                                    std::uint64_t newest) {
  if (total(measure) <= most) return std::nullopt;
  double shares = 0;
  for (const auto& [name, user] : users_) shares += user.share;
  auto first = users_.end();
  double first_for_its_share = static_cast<double>(most) / shares;
  for (auto user = users_.begin(); user != users_.end(); ++user) {
    if (user->second.entries.front().job == newest) continue;
    const double for_its_share =
        static_cast<double>(amount(user->second, measure)) / user->second.share;
    if (for_its_share <= first_for_its_share) continue;
    first = user;
    first_for_its_share = for_its_share;
  }
  if (first == users_.end()) return std::nullopt;
  return take_oldest(first);
}

std::optional<std::uint64_t> Retention::take_before(double time) {
  for (auto user = users_.begin(); user != users_.end(); ++user)
    if (user->second.entries.front().ended_at < time) return take_oldest(user);
  return std::nullopt;
}

}  // namespace metamer::service
