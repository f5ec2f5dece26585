#pragma once

#include <map>
#include <memory>
#include <vector>

#include "server/service/access/accounts.h"
#include "server/service/limits.h"
#include "server/service/views/view.h"

namespace metamer::service {

using ViewPtr = std::shared_ptr<View>;

/// All views that are open, of all clients. Each belongs to its client's session (ViewStreams),
/// since it wakes that: here one that is gone is no longer found.
class Views {
 public:
  explicit Views(const Limits& limits) : limits_(limits) {}

  /// Refused (LIMIT): as many are open as there may be, in all or of one owner.
  tl::expected<ViewPtr, Refusal> open(v1::OpenView open, AssetHolds assets,
                                      std::function<void()> wake, const AccountPtr& owner);

  std::size_t size() const;
  /// Bytes that all take of their workers, by estimate.
  std::uint64_t memory() const;
  std::vector<ViewPtr> of(v1::Backend backend) const;
  /// Gives the view that a worker speaks of; null: it is closed, and the worker has not heard.
  ViewPtr find(std::uint64_t id) const;
  /// Ends those of a backend: it has lost its worker, or there is none.
  void end(v1::Backend backend, const std::string& reason);

 private:
  const Limits& limits_;
  std::uint64_t last_id_ = 0;
  struct Known {
    std::weak_ptr<View> view;
    AccountPtr owner;
  };
  std::map<std::uint64_t, Known> views_;
};

}  // namespace metamer::service
