#include "server/service/access/login_limit.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace metamer::service {

namespace {

/// How many failures are left of `failures` after a while.
double left_of(double failures, LoginLimit::Clock::duration passed) {
  const std::chrono::duration<double> seconds = passed;
  return std::max(0.0, failures - seconds / LoginLimit::recovery);
}

}  // namespace

LoginLimit::Verdict LoginLimit::failed(const std::string& source, Clock::time_point now) {
  if (!known_.contains(source) && known_.size() >= sources) forget(now);
  Source& known = known_[source];
  known.failures = left_of(known.failures, now - known.at);
  known.at = now;
  Verdict verdict;
  if (known.failures + 1 > most) {
    const double missing = known.failures + 1 - most;
    verdict.limited = true;
    verdict.wait = std::chrono::seconds(
        static_cast<std::int64_t>(std::ceil(missing * static_cast<double>(recovery.count()))));
    ++known.unreported;
  } else {
    known.failures += 1;
    verdict.unreported = std::exchange(known.unreported, 0);
  }
  return verdict;
}

/// Makes room: those who have all of theirs back go, and else the oldest.
void LoginLimit::forget(Clock::time_point now) {
  std::erase_if(known_, [&](const auto& known) {
    return left_of(known.second.failures, now - known.second.at) == 0;
  });
  if (known_.size() < sources) return;
  known_.erase(std::min_element(known_.begin(), known_.end(), [](const auto& a, const auto& b) {
    return a.second.at < b.second.at;
  }));
}

}  // namespace metamer::service
