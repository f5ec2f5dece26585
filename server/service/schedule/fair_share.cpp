#include "server/service/schedule/fair_share.h"

#include <algorithm>
#include <cassert>
#include <tuple>

namespace metamer::service {

double turn_seconds(double quantum, double beginning) {
  constexpr double beginnings = 20, longest = 30;
  return std::max(quantum, std::min(longest, beginnings * beginning));
}

void FairShare::set_present(std::string_view user, bool present) {
  auto known = users_.find(user);
  if (known == users_.end()) {
    if (!present) return;
    known = users_.emplace(user, User{now_, ++turns_, false}).first;
  }
  if (present && !known->second.present) known->second.tag = std::max(known->second.tag, now_);
  known->second.present = present;
  if (!present) forget_settled();
}

/// Who is absent and would begin at the turn under way anyway; with nobody present, all.
void FairShare::forget_settled() {
  const bool anybody = std::any_of(users_.begin(), users_.end(),
                                   [](const auto& user) { return user.second.present; });
  if (!anybody) {
    users_.clear();
    now_ = 0;
    return;
  }
  std::erase_if(users_,
                [&](const auto& user) { return !user.second.present && user.second.tag <= now_; });
}

std::optional<std::size_t> FairShare::choose(std::span<const Claim> waiting) const {
  const auto rank = [&](const Claim& claim) {
    const auto known = users_.find(claim.user);
    const User user = known == users_.end() ? User{now_, 0, false} : known->second;
    return std::tuple(user.tag, user.turn, claim.user, -std::int64_t{claim.priority}, claim.order);
  };
  const auto first =
      std::min_element(waiting.begin(), waiting.end(),
                       [&](const Claim& a, const Claim& b) { return rank(a) < rank(b); });
  if (first == waiting.end()) return std::nullopt;
  return static_cast<std::size_t>(first - waiting.begin());
}

void FairShare::begin(std::string_view user, double share) {
  set_present(user, true);
  User& known = users_.find(user)->second;
  now_ = std::max(now_, known.tag);
  known.turn = ++turns_;
  charge(user, share, least_turn);
  forget_settled();
}

void FairShare::charge(std::string_view user, double share, double seconds) {
  assert(share >= min_share && share <= max_share && seconds >= 0);
  // Who has gone meanwhile, its only job cancelled, say, is charged all the same.
  auto known = users_.find(user);
  if (known == users_.end()) known = users_.emplace(user, User{now_, ++turns_, false}).first;
  known->second.tag += seconds / share;
}

std::vector<FairShare::Lead> FairShare::leads() const {
  std::vector<Lead> leads;
  for (const auto& [name, user] : users_)
    if (user.tag != now_) leads.push_back({name, user.tag - now_});
  return leads;
}

void FairShare::restore(const std::vector<Lead>& kept) {
  for (auto& [name, user] : users_) user.tag = now_;
  for (const Lead& lead : kept) {
    const auto known = users_.try_emplace(lead.user, User{0, ++turns_, false}).first;
    known->second.tag = now_ + lead.seconds;
  }
  forget_settled();
}

}  // namespace metamer::service
