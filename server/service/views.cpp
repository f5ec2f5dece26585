#include "server/service/views.h"

#include "server/service/limits.h"

namespace metamer::service {

tl::expected<ViewPtr, Refusal> Views::open(v1::OpenView open, AssetHolds assets,
                                           std::function<void()> wake) {
  std::erase_if(views_, [](const auto& known) { return known.second.expired(); });
  if (views_.size() >= max_views)
    return refuse(v1::Error::LIMIT, "the server has " + std::to_string(max_views) +
                                        " views open already, which is all");
  const std::uint64_t id = ++last_id_;
  auto view = std::make_shared<View>(id, std::move(open), std::move(assets), std::move(wake));
  views_.emplace(id, view);
  return view;
}

std::vector<ViewPtr> Views::of(v1::Backend backend) const {
  std::vector<ViewPtr> result;
  for (const auto& [id, known] : views_) {
    ViewPtr view = known.lock();
    if (view && view->backend() == backend && !view->ended()) result.push_back(std::move(view));
  }
  return result;
}

ViewPtr Views::find(std::uint64_t id) const {
  const auto found = views_.find(id);
  ViewPtr view = found == views_.end() ? nullptr : found->second.lock();
  return view && !view->ended() ? view : nullptr;
}

void Views::end(v1::Backend backend, const std::string& reason) {
  v1::ViewClosed closed;
  closed.mutable_reason()->set_kind(v1::Failed::WORKER);
  closed.mutable_reason()->set_reason(reason);
  for (const ViewPtr& view : of(backend)) view->end(closed);
}

}  // namespace metamer::service
