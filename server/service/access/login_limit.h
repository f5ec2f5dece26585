#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>

namespace metamer::service {

/// Counts the failed logins of each source (an address, a user of this machine): as many as a
/// person makes are answered and logged one by one, beyond that they are only counted. A source
/// gets one back each `recovery`. Who says a valid token is never held up: tokens are too long to
/// be guessed, and others may share the address.
class LoginLimit {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr unsigned most = 5;
  static constexpr std::chrono::seconds recovery{10};
  /// Sources that are remembered; beyond these the one whose failure is the oldest is forgotten.
  static constexpr std::size_t sources = 4096;

  struct Verdict {
    bool limited = false;          ///< It has failed too often.
    std::chrono::seconds wait{0};  ///< Until it has one again.
    std::uint64_t unreported = 0;  ///< Failures since the last that was not limited.
  };
  /// Takes note of one more failure.
  Verdict failed(const std::string& source, Clock::time_point now);

  std::size_t size() const { return known_.size(); }

 private:
  struct Source {
    double failures = 0;
    Clock::time_point at;
    std::uint64_t unreported = 0;
  };
  void forget(Clock::time_point now);

  std::map<std::string, Source> known_;
};

}  // namespace metamer::service
