#pragma once

#include <algorithm>
#include <array>
#include <chrono>

namespace metamer::client {

/// Counts how often something was made anew by itself: what fails at once each time is not to be
/// made anew for ever.
class RestartLimit {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::minutes within{1};

  /// Whether it may be made once more at this time, and counts it then: not where that was so three
  /// times within the minute before.
  bool take(Clock::time_point now) {
    const auto oldest = std::min_element(taken_.begin(), taken_.end());
    if (now - *oldest < within && *oldest != Clock::time_point{}) return false;
    *oldest = now;
    return true;
  }
  void forget() { taken_ = {}; }

 private:
  std::array<Clock::time_point, 3> taken_{};  ///< The epoch: never.
};

}  // namespace metamer::client
