#include "server/service/views.h"

#include "server/service/limits.h"

namespace metamer::service {

tl::expected<ViewPtr, Refusal> Views::open(v1::OpenView open, AssetHolds assets,
                                           std::function<void()> wake) {
  if (views_.size() >= max_views)
    return refuse(v1::Error::LIMIT, "the server has " + std::to_string(max_views) +
                                        " views open already, which is all");
  const std::uint64_t id = ++last_id_;
  return views_[id] =
             std::make_shared<View>(id, std::move(open), std::move(assets), std::move(wake));
}

std::vector<ViewPtr> Views::of(v1::Backend backend) const {
  std::vector<ViewPtr> result;
  for (const auto& [id, view] : views_)
    if (view->backend() == backend && !view->ended()) result.push_back(view);
  return result;
}

ViewPtr Views::find(std::uint64_t id) const {
  const auto found = views_.find(id);
  return found == views_.end() || found->second->ended() ? nullptr : found->second;
}

void Views::end(v1::Backend backend, const std::string& reason) {
  v1::ViewClosed closed;
  closed.mutable_reason()->set_kind(v1::Failed::WORKER);
  closed.mutable_reason()->set_reason(reason);
  for (const ViewPtr& view : of(backend)) view->end(closed);
}

}  // namespace metamer::service
