#include "server/service/schedule/work_ledger.h"

#include <cassert>
#include <cmath>

namespace metamer::service {

namespace {

constexpr double hour_seconds = 3600;

std::int64_t hour_of(double time) {
  return static_cast<std::int64_t>(std::floor(time / hour_seconds));
}

}  // namespace

std::int64_t WorkLedger::first_hour(double now) { return hour_of(now) - hours + 1; }

void WorkLedger::spend(std::string_view user, double seconds, double now) {
  auto known = users_.find(user);
  if (known == users_.end()) known = users_.emplace(user, Hours{}).first;
  Hour& hour = known->second[hour_of(now)];
  hour.seconds += seconds;
  hour.changed = true;
}

double WorkLedger::spent(std::string_view user, double now) const {
  const auto known = users_.find(user);
  if (known == users_.end()) return 0;
  double sum = 0;
  for (auto hour = known->second.lower_bound(first_hour(now)); hour != known->second.end(); ++hour)
    sum += hour->second.seconds;
  return sum;
}

std::map<std::string, double> WorkLedger::all_spent(double now) const {
  std::map<std::string, double> all;
  for (const auto& [user, hours] : users_)
    if (const double seconds = spent(user, now); seconds > 0) all.emplace(user, seconds);
  return all;
}

std::optional<double> WorkLedger::free_at(std::string_view user, double most, double now) const {
  assert(most > 0);
  double sum = spent(user, now);
  if (sum < most) return std::nullopt;
  const Hours& of_user = users_.find(user)->second;
  std::int64_t last = 0;
  for (auto hour = of_user.lower_bound(first_hour(now)); sum >= most && hour != of_user.end();
       ++hour) {
    last = hour->first;
    sum -= hour->second.seconds;
  }
  return static_cast<double>(last + hours) * hour_seconds;
}

std::vector<WorkLedger::Entry> WorkLedger::take_changes(double now) {
  std::vector<Entry> changes;
  for (auto user = users_.begin(); user != users_.end();) {
    Hours& of_user = user->second;
    of_user.erase(of_user.begin(), of_user.lower_bound(first_hour(now)));
    for (auto& [hour, spent] : of_user) {
      if (spent.changed) changes.push_back({user->first, hour, spent.seconds});
      spent.changed = false;
    }
    user = of_user.empty() ? users_.erase(user) : std::next(user);
  }
  return changes;
}

void WorkLedger::restore(const std::vector<Entry>& kept) {
  for (const Entry& entry : kept) users_[entry.user][entry.hour].seconds += entry.seconds;
}

}  // namespace metamer::service
