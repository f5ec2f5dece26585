#include "server/service/net/door.h"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

namespace metamer::service {

std::size_t Door::count(const std::string& source) const {
  return static_cast<std::size_t>(std::count_if(
      waiting_.begin(), waiting_.end(),
      [&](const Newcomer& newcomer) { return newcomer.close && newcomer.source == source; }));
}

void Door::drop_oldest(const std::string& source) {
  const auto oldest = std::find_if(waiting_.begin(), waiting_.end(), [&](const Newcomer& one) {
    return one.close && one.source == source;
  });
  if (oldest == waiting_.end()) return;
  spdlog::debug("a connection of {} that said nothing makes room", source);
  // It leaves when its coroutines have ended; until then it counts for nothing.
  std::exchange(oldest->close, {})();
}

Door::Place Door::enter(std::string source) {
  std::size_t all = 0;
  std::string greediest = source;
  std::size_t most = count(source);
  if (most >= most_of_a_source_) {
    drop_oldest(source);
  } else {
    for (const Newcomer& newcomer : waiting_) {
      all += newcomer.close != nullptr;
      if (const std::size_t has = count(newcomer.source); has > most) {
        most = has;
        greediest = newcomer.source;
      }
    }
    if (all >= most_) drop_oldest(greediest);
  }
  return waiting_.insert(waiting_.end(), {std::move(source), [] {}});
}

void Door::close() {
  for (Newcomer& newcomer : waiting_)
    if (const auto end = std::exchange(newcomer.close, {})) end();
}

}  // namespace metamer::service
