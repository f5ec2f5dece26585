#pragma once

#include <cstddef>
#include <functional>
#include <list>
#include <string>

namespace metamer::service {

/// Those who have connected and are not let in yet: few, and apart from the sessions, so that who
/// says nothing takes no place from who is known. One more than there is room for ends the oldest
/// of the source (a user of this machine, an address) that has most here: a flood ends itself. All
/// on one thread.
class Door {
 public:
  struct Newcomer {
    std::string source;
    std::function<void()> close;  ///< Ends its connection; it then leaves.
  };
  using Place = std::list<Newcomer>::iterator;

  Door(std::size_t most, std::size_t most_of_a_source)
      : most_(most), most_of_a_source_(most_of_a_source) {}

  /// A place, until leave(). Those who have to go for it are closed at once.
  Place enter(std::string source);
  void leave(Place place) { waiting_.erase(place); }
  /// Closes all.
  void close();
  std::size_t size() const { return waiting_.size(); }

 private:
  std::size_t count(const std::string& source) const;
  void drop_oldest(const std::string& source);

  std::size_t most_, most_of_a_source_;
  std::list<Newcomer> waiting_;  // oldest first
};

}  // namespace metamer::service
