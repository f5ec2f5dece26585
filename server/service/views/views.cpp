#include "server/service/views/views.h"

#include <algorithm>
#include <limits>

namespace metamer::service {

tl::expected<ViewPtr, Refusal> Views::open(v1::OpenView open, AssetHolds assets,
                                           std::function<void()> wake, const AccountPtr& owner) {
  std::erase_if(views_, [](const auto& known) { return known.second.view.expired(); });
  const auto own = std::count_if(views_.begin(), views_.end(),
                                 [&](const auto& known) { return known.second.owner == owner; });
  if (views_.size() < limits_.views &&
      !may_take(static_cast<std::uint64_t>(own), 1, limits_.views - views_.size()))
    return refuse(v1::Error::LIMIT, owner->name + " has its share of the server's " +
                                        std::to_string(limits_.views) + " views");
  if (views_.size() >= limits_.views)
    return refuse(v1::Error::LIMIT, "the server has " + std::to_string(limits_.views) +
                                        " views open already, which is all");
  const std::uint64_t id = ++last_id_;
  auto view = std::make_shared<View>(id, std::move(open), std::move(assets), std::move(wake));
  views_.emplace(id, Known{view, owner});
  return view;
}

std::size_t Views::size() const {
  return static_cast<std::size_t>(
      std::count_if(views_.begin(), views_.end(),
                    [](const auto& known) { return !known.second.view.expired(); }));
}

std::uint64_t Views::memory() const {
  std::uint64_t sum = 0;
  for (const auto& [id, known] : views_)
    if (const ViewPtr view = known.view.lock()) {
      const std::uint64_t bytes = view->memory();
      sum += std::min(bytes, std::numeric_limits<std::uint64_t>::max() - sum);
    }
  return sum;
}

std::vector<ViewPtr> Views::of(v1::Backend backend) const {
  std::vector<ViewPtr> result;
  for (const auto& [id, known] : views_) {
    ViewPtr view = known.view.lock();
    if (view && view->backend() == backend && !view->ended()) result.push_back(std::move(view));
  }
  return result;
}

ViewPtr Views::find(std::uint64_t id) const {
  const auto found = views_.find(id);
  ViewPtr view = found == views_.end() ? nullptr : found->second.view.lock();
  return view && !view->ended() ? view : nullptr;
}

void Views::end(v1::Backend backend, const std::string& reason) {
  v1::ViewClosed closed;
  closed.mutable_reason()->set_kind(v1::Failed::WORKER);
  closed.mutable_reason()->set_reason(reason);
  for (const ViewPtr& view : of(backend)) view->end(closed);
}

}  // namespace metamer::service
