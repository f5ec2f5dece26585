#include "server/service/net/handshakes.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <map>

namespace metamer::service {

std::size_t Handshakes::running() const {
  return static_cast<std::size_t>(std::count_if(
      running_.begin(), running_.end(), [](const Running& one) { return one.close != nullptr; }));
}

std::size_t Handshakes::count(const std::string& source) const {
  return static_cast<std::size_t>(
      std::count_if(running_.begin(), running_.end(),
                    [&](const Running& one) { return one.close && one.source == source; }));
}

Handshakes::Place Handshakes::oldest(const std::string& source) {
  return std::find_if(running_.begin(), running_.end(),
                      [&](const Running& one) { return one.close && one.source == source; });
}

std::string Handshakes::greediest() const {
  std::map<std::string, std::size_t> counts;
  for (const Running& one : running_) counts[one.source] += one.close != nullptr;
  const auto most =
      std::max_element(counts.begin(), counts.end(),
                       [](const auto& a, const auto& b) { return a.second < b.second; });
  return most == counts.end() ? std::string() : most->first;
}

tl::expected<Handshakes::Place, Handshakes::Clock::time_point> Handshakes::enter(
    const std::string& source, std::function<void()> close, Clock::time_point now) {
  const bool has_share = count(source) >= limits_.source_handshakes;
  if (has_share || running() >= limits_.handshakes) {
    const Place in_the_way = oldest(has_share ? source : greediest());
    const auto until = in_the_way->began + patience_.handshake;
    if (now < until) return tl::unexpected(until);
    spdlog::debug("a handshake of {} that stands still makes room", in_the_way->source);
    // It leaves when its coroutine has ended; until then it counts for nothing.
    std::exchange(in_the_way->close, {})();
  }
  return running_.insert(running_.end(), {source, now, std::move(close)});
}

void Handshakes::leave(Place place) {
  running_.erase(place);
  freed_();
}

}  // namespace metamer::service
