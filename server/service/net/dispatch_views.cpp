// Views.
#include "server/service/net/dispatch.h"

namespace metamer::service {

Dispatch::Answer Dispatch::open_view(std::uint64_t request_id, v1::OpenView open) {
  if (context_.closing) return refuse(v1::Error::CLOSING, "the server ends and opens no views");
  if (views_.size() >= context_.limits.session_views)
    return refuse(v1::Error::LIMIT, "a client may have " +
                                        std::to_string(context_.limits.session_views) +
                                        " views open at a time");
  auto assets = hold(open.scene_sha256(), open.asset(), open.backend());
  if (!assets) return tl::unexpected(assets.error());
  if (const auto why = context_.queue.refuse_view(View::size_of(*assets, open.scene_sha256()), 0))
    return refuse(v1::Error::LIMIT, *why);
  const auto view =
      context_.views.open(std::move(open), *std::move(assets), views_.wake(), account_);
  if (!view) return tl::unexpected(view.error());
  views_.add(request_id, *view);
  context_.host_of(**view).open(**view);
  return std::nullopt;
}

/// Another scene has its assets by itself: those of the one before go when it is shown.
tl::expected<View::Order, Refusal> Dispatch::update(View& view, const v1::UpdateView& update) {
  if (update.scene_sha256().empty()) {
    for (const v1::AssetName& asset : update.asset())
      if (const auto digest = digest_from_bytes(asset.sha256()); digest && !may_know(*digest))
        return refuse(v1::Error::MISSING_ASSET, "the store lacks " + asset.name());
    return view.update(update);
  }
  auto assets = hold(update.scene_sha256(), update.asset(), view.backend());
  if (!assets) return tl::unexpected(assets.error());
  // Both are there until the worker has made the other.
  if (const auto why = context_.queue.refuse_view(View::size_of(*assets, update.scene_sha256()), 0))
    return refuse(v1::Error::LIMIT, *why);
  return view.update(update, std::make_unique<AssetHolds>(*std::move(assets)));
}

Dispatch::Answer Dispatch::tell_view(
    std::uint64_t view_id, const std::function<tl::expected<View::Order, Refusal>(View&)>& ask) {
  const ViewPtr view = views_.find(view_id);
  if (!view) return refuse(v1::Error::NOT_FOUND, "there is no view " + std::to_string(view_id));
  if (view->ended()) return std::nullopt;  // its last event is on the way
  auto order = ask(*view);
  if (!order) return tl::unexpected(order.error());
  if (*order) context_.host_of(*view).tell(*std::move(*order));
  return std::nullopt;
}

}  // namespace metamer::service
