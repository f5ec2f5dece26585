#include "server/service/net/dispatch.h"

#include "common/wire/protocol.h"
#include "server/service/access/permit.h"
#include "server/service/limits.h"
#include "server/service/text.h"

namespace metamer::service {

namespace {

constexpr const char* server_name = "metamerd " METAMER_VERSION;

v1::Envelope to_envelope(const Refusal& refusal) {
  v1::Envelope envelope;
  envelope.mutable_error()->set_code(refusal.code);
  envelope.mutable_error()->set_message(refusal.message);
  return envelope;
}

}  // namespace

asio::awaitable<std::optional<v1::Envelope>> Dispatch::answer(v1::Envelope request) {
  Answer answer = co_await dispatch(request);
  if (!answer) {
    ++context_.traffic.refusals[answer.error().code];
    answer = to_envelope(answer.error());
  }
  if (*answer) (*answer)->set_request_id(request.request_id());
  co_return *std::move(answer);
}

asio::awaitable<Dispatch::Answer> Dispatch::dispatch(v1::Envelope& request) {
  using Body = v1::Envelope;
  if (!greeted() && request.body_case() != Body::kHello) {
    co_return refuse(v1::Error::ORDER, "the first message has to be Hello");
  }
  if (greeted())
    if (auto may = permit(*identity_, request.body_case()); !may)
      co_return tl::unexpected(may.error());
  std::vector<Digest> named = named_assets(request);
  if (!named.empty()) co_await context_.store.look(std::move(named));
  switch (request.body_case()) {
    case Body::kHello:
      co_return hello(request.hello());
    case Body::kPing: {
      v1::Envelope pong;
      pong.mutable_pong();
      co_return pong;
    }
    case Body::kGetInfo:
      co_return info();
    case Body::kOfferAssets:
      co_return offer(request.offer_assets());
    case Body::kAssetChunk:
      co_return co_await chunk(request.asset_chunk());
    case Body::kSubmit:
      co_return co_await submit(std::move(*request.mutable_submit()));
    case Body::kWatch:
      co_return watch(request.request_id(), request.watch());
    case Body::kUnwatch:
      co_return unwatch(request.unwatch());
    case Body::kListJobs:
      co_return list(request.list_jobs());
    case Body::kCancel:
      co_return co_await order(Order::cancel, request.cancel().job_id());
    case Body::kPause:
      co_return co_await order(Order::pause, request.pause().job_id());
    case Body::kResume:
      co_return co_await order(Order::resume, request.resume().job_id());
    case Body::kPrioritize:
      co_return co_await prioritize(request.prioritize());
    case Body::kOpenView:
      co_return open_view(request.request_id(), std::move(*request.mutable_open_view()));
    case Body::kUpdateView:
      co_return tell_view(request.update_view().view_id(),
                          [&](View& view) { return update(view, request.update_view()); });
    case Body::kNextFrame:
      co_return tell_view(request.next_frame().view_id(),
                          [&](View& view) { return view.next_frame(request.next_frame().xyz()); });
    case Body::kCloseView:
      co_return tell_view(request.close_view().view_id(), [](View& view) {
        view.end({});
        return tl::expected<View::Order, Refusal>(view.closing());
      });
    case Body::kProbe:
      co_return tell_view(request.probe().view_id(),
                          [&](View& view) { return view.probe(request.probe()); });
    case Body::kWelcome:
    case Body::kPong:
    case Body::kInfo:
    case Body::kMissingAssets:
    case Body::kAssetStored:
    case Body::kSubmitted:
    case Body::kJobEvent:
    case Body::kJobList:
    case Body::kJobSummary:
    case Body::kError:
    case Body::kViewEvent:
    case Body::kUnwatched:
      co_return refuse(v1::Error::UNKNOWN_MESSAGE, "that message is the server's to send");
    case Body::BODY_NOT_SET:
      co_return refuse(v1::Error::UNKNOWN_MESSAGE, "this server does not know that message");
  }
  co_return refuse(v1::Error::UNKNOWN_MESSAGE, "this server does not know that message");
}

Dispatch::Answer Dispatch::hello(const v1::Hello& hello) {
  if (greeted()) return refuse(v1::Error::ORDER, "Hello was said before");
  if (hello.protocol_version() != wire::protocol_version) {
    return refuse(v1::Error::VERSION,
                  "this server speaks version " + std::to_string(wire::protocol_version) +
                      " of the protocol, the client " + std::to_string(hello.protocol_version()));
  }
  auto identity = admit_(hello.token());
  if (!identity) return tl::unexpected(identity.error());
  account_ = context_.accounts.named(identity->user);
  identity_ = *std::move(identity);
  holds_.emplace(context_.store, account_);
  ++context_.traffic.greeted;
  client_ = shortened(hello.client(), max_job_name);
  v1::Envelope envelope;
  v1::Welcome& welcome = *envelope.mutable_welcome();
  welcome.set_user(identity_->user);
  welcome.set_role(identity_->role);
  welcome.set_protocol_version(wire::protocol_version);
  welcome.set_server(server_name);
  *welcome.mutable_limits() = limits_message(context_.limits);
  *welcome.mutable_capabilities() = context_.cpu.capabilities();
  if (context_.state) welcome.set_server_id(context_.state->server_id());
  return envelope;
}

Dispatch::Answer Dispatch::info() {
  v1::Envelope envelope;
  v1::Info& info = *envelope.mutable_info();
  info.set_server(server_name);
  info.set_uptime(
      std::chrono::duration<double>(std::chrono::steady_clock::now() - context_.started).count());
  *info.mutable_limits() = limits_message(context_.limits);
  v1::Capabilities& capabilities = *info.mutable_capabilities();
  capabilities = context_.cpu.capabilities();
  if (context_.gl.capabilities().has_gl()) {
    capabilities.mutable_backend()->MergeFrom(context_.gl.capabilities().backend());
    *capabilities.mutable_gl() = context_.gl.capabilities().gl();
  }
  *info.add_worker() = context_.cpu.info();
  *info.add_worker() = context_.gl.info();
  *info.add_worker() = context_.cpu_views.info();
  info.set_jobs_queued(context_.queue.queued());
  info.set_jobs_running(context_.queue.running());
  // All that there is would tell who sends an asset whether another has sent it before.
  info.set_store_bytes(identity_->is_admin() ? context_.store.bytes() : account_->asset_bytes);
  if (context_.state)
    info.set_state_bytes(context_.queue.picture_bytes(identity_->is_admin() ? nullptr : account_));
  info.set_sessions(context_.sessions());
  if (context_.tell_usage) context_.tell_usage(*identity_, info);
  if (context_.state && context_.state->trouble())
    info.set_trouble(*context_.state->trouble());
  else if (const auto& trouble = context_.store.disk().text())
    info.set_trouble(*trouble);
  return envelope;
}

}  // namespace metamer::service
