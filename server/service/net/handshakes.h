#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <list>
#include <string>
#include <tl/expected.hpp>
#include <utility>

#include "server/service/limits.h"

namespace metamer::service {

/// The TLS handshakes that run at once: each costs a signature, on the loop's thread, before
/// anybody is known. Whoever has begun to speak takes a place or waits for one; one that has stood
/// still for longer than a handshake takes gives its place to who wants it: of the same source (a
/// user of this machine, an address) where that has its share, else of the source that has most.
/// All on one thread.
class Handshakes {
 public:
  using Clock = std::chrono::steady_clock;
  struct Running {
    std::string source;
    Clock::time_point began;
    std::function<void()> close;  ///< Ends its connection; it then leaves. Null: it is ended.
  };
  using Place = std::list<Running>::iterator;

  /// `freed` is called when a place may be had; those who wait then try anew.
  Handshakes(const Limits& limits, const Patience& patience, std::function<void()> freed)
      : limits_(limits), patience_(patience), freed_(std::move(freed)) {}

  /// Takes a place, until leave(); or says when to try again at the latest.
  tl::expected<Place, Clock::time_point> enter(const std::string& source,
                                               std::function<void()> close, Clock::time_point now);
  void leave(Place place);
  /// Those that are not ended.
  std::size_t running() const;

 private:
  std::size_t count(const std::string& source) const;
  Place oldest(const std::string& source);
  std::string greediest() const;

  const Limits& limits_;
  const Patience& patience_;
  std::function<void()> freed_;
  std::list<Running> running_;  // oldest first
};

}  // namespace metamer::service
