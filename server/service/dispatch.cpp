#include "server/service/dispatch.h"

#include <spdlog/spdlog.h>

#include "common/wire/protocol.h"
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

tl::expected<Digest, Refusal> to_digest(const std::string& bytes) {
  if (const auto digest = digest_from_bytes(bytes)) return *digest;
  return refuse(v1::Error::LIMIT, "a digest has 32 bytes, not " + std::to_string(bytes.size()));
}

tl::unexpected<Refusal> no_such_job(std::uint64_t id) {
  return refuse(v1::Error::NOT_FOUND, "there is no job " + std::to_string(id));
}

}  // namespace

std::optional<v1::Envelope> Dispatch::answer(v1::Envelope request) {
  Answer answer = dispatch(request);
  if (!answer) answer = to_envelope(answer.error());
  if (*answer) (*answer)->set_request_id(request.request_id());
  return *std::move(answer);
}

Dispatch::Answer Dispatch::dispatch(v1::Envelope& request) {
  using Body = v1::Envelope;
  if (!greeted_ && request.body_case() != Body::kHello) {
    return refuse(v1::Error::ORDER, "the first message has to be Hello");
  }
  switch (request.body_case()) {
    case Body::kHello:
      return hello(request.hello());
    case Body::kPing: {
      v1::Envelope pong;
      pong.mutable_pong();
      return pong;
    }
    case Body::kGetInfo:
      return info();
    case Body::kOfferAssets:
      return offer(request.offer_assets());
    case Body::kAssetChunk:
      return chunk(request.asset_chunk());
    case Body::kSubmit:
      return submit(std::move(*request.mutable_submit()));
    case Body::kWatch:
      return watch(request.request_id(), request.watch());
    case Body::kListJobs:
      return list();
    case Body::kCancel:
      return order(Order::cancel, request.cancel().job_id());
    case Body::kPause:
      return order(Order::pause, request.pause().job_id());
    case Body::kResume:
      return order(Order::resume, request.resume().job_id());
    case Body::kOpenView:
      return open_view(request.request_id(), std::move(*request.mutable_open_view()));
    case Body::kUpdateView:
      return tell_view(request.update_view());
    case Body::kNextFrame:
      return tell_view(request.next_frame());
    case Body::kCloseView:
      return tell_view(request.close_view());
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
      return refuse(v1::Error::UNKNOWN_MESSAGE, "that message is the server's to send");
    case Body::BODY_NOT_SET:
      return refuse(v1::Error::UNKNOWN_MESSAGE, "this server does not know that message");
  }
  return refuse(v1::Error::UNKNOWN_MESSAGE, "this server does not know that message");
}

Dispatch::Answer Dispatch::hello(const v1::Hello& hello) {
  if (greeted_) return refuse(v1::Error::ORDER, "Hello was said before");
  if (hello.protocol_version() != wire::protocol_version) {
    return refuse(v1::Error::VERSION,
                  "this server speaks version " + std::to_string(wire::protocol_version) +
                      " of the protocol, the client " + std::to_string(hello.protocol_version()));
  }
  greeted_ = true;
  spdlog::info("a client says hello: {}", shortened(hello.client(), max_job_name));
  v1::Envelope envelope;
  v1::Welcome& welcome = *envelope.mutable_welcome();
  welcome.set_protocol_version(wire::protocol_version);
  welcome.set_server(server_name);
  *welcome.mutable_limits() = limits_message();
  *welcome.mutable_capabilities() = context_.cpu.capabilities();
  return envelope;
}

Dispatch::Answer Dispatch::info() {
  v1::Envelope envelope;
  v1::Info& info = *envelope.mutable_info();
  info.set_server(server_name);
  info.set_uptime(
      std::chrono::duration<double>(std::chrono::steady_clock::now() - context_.started).count());
  *info.mutable_limits() = limits_message();
  v1::Capabilities& capabilities = *info.mutable_capabilities();
  capabilities = context_.cpu.capabilities();
  if (context_.gl.capabilities().has_gl()) {
    capabilities.mutable_backend()->MergeFrom(context_.gl.capabilities().backend());
    *capabilities.mutable_gl() = context_.gl.capabilities().gl();
  }
  *info.add_worker() = context_.cpu.info();
  *info.add_worker() = context_.gl.info();
  info.set_jobs_queued(context_.queue.queued());
  info.set_jobs_running(context_.queue.running());
  info.set_store_bytes(context_.store.bytes());
  info.set_sessions(context_.sessions());
  return envelope;
}

Dispatch::Answer Dispatch::offer(const v1::OfferAssets& offer) {
  v1::Envelope envelope;
  v1::MissingAssets& missing = *envelope.mutable_missing_assets();
  for (const std::string& bytes : offer.sha256()) {
    const auto digest = to_digest(bytes);
    if (!digest) return tl::unexpected(digest.error());
    if (holds_.size() >= max_held_assets) {
      return refuse(v1::Error::LIMIT,
                    "a client may hold " + std::to_string(max_held_assets) + " assets");
    }
    if (!holds_.add(*digest)) missing.add_sha256(bytes);
  }
  return envelope;
}

Dispatch::Answer Dispatch::chunk(const v1::AssetChunk& chunk) {
  const auto digest = to_digest(chunk.sha256());
  if (!digest) return tl::unexpected(digest.error());
  if (auto taken = take_chunk(*digest, chunk); !taken) {
    upload_.reset();
    return tl::unexpected(taken.error());
  }
  if (upload_) return std::nullopt;
  v1::Envelope envelope;
  envelope.mutable_asset_stored()->set_sha256(chunk.sha256());
  return envelope;
}

tl::expected<void, Refusal> Dispatch::take_chunk(const Digest& digest,
                                                 const v1::AssetChunk& chunk) {
  if (chunk.data().size() > wire::max_chunk) {
    return refuse(v1::Error::LIMIT, "a chunk of " + std::to_string(chunk.data().size()) +
                                        " bytes is over the limit of " +
                                        std::to_string(wire::max_chunk));
  }
  if (upload_ && (upload_->digest() != digest || upload_->size() != chunk.size())) {
    return refuse(v1::Error::ORDER, "a chunk of another asset came before this one was complete");
  }
  if (!upload_) {
    if (chunk.offset() != 0) {
      return refuse(v1::Error::ORDER, "an asset's first chunk has to be at offset 0, not " +
                                          std::to_string(chunk.offset()));
    }
    if (holds_.size() >= max_held_assets) {
      return refuse(v1::Error::LIMIT,
                    "a client may hold " + std::to_string(max_held_assets) + " assets");
    }
    auto upload = AssetUpload::begin(context_.store, account_, digest, chunk.size());
    if (!upload) return tl::unexpected(upload.error());
    upload_.emplace(*std::move(upload));
  }
  if (auto added = upload_->add(chunk.offset(), chunk.data()); !added) return added;
  if (!upload_->complete()) return {};
  if (auto stored = upload_->commit(); !stored) return stored;
  upload_.reset();
  holds_.add(digest);
  return {};
}

/// Keeps a scene's assets from eviction, before anything else may need room.
tl::expected<AssetHolds, Refusal> Dispatch::hold(const std::string& scene, const AssetNames& assets,
                                                 v1::Backend backend) {
  if (static_cast<std::size_t>(assets.size()) > limits::max_assets) {
    return refuse(v1::Error::LIMIT, "a scene with " + std::to_string(assets.size()) +
                                        " assets is over the limit of " +
                                        std::to_string(limits::max_assets));
  }
  if (!v1::Backend_IsValid(backend))
    return refuse(v1::Error::LIMIT, "there is no backend of number " + std::to_string(backend));
  AssetHolds holds(context_.store, account_);
  const auto add = [&](const std::string& bytes,
                       const std::string& name) -> tl::expected<void, Refusal> {
    const auto digest = to_digest(bytes);
    if (!digest) return tl::unexpected(digest.error());
    if (holds.add(*digest)) return {};
    if (context_.store.damaged(*digest))
      return refuse(v1::Error::MISSING_ASSET, holds.describe_damage(*digest, name));
    return refuse(v1::Error::MISSING_ASSET,
                  "the store lacks " + name + " (" + to_hex(*digest) + ")");
  };
  if (auto held = add(scene, "the scene"); !held) return tl::unexpected(held.error());
  for (const v1::AssetName& asset : assets)
    if (auto held = add(asset.sha256(), asset.name()); !held) return tl::unexpected(held.error());
  return holds;
}

Dispatch::Answer Dispatch::submit(v1::Submit submit) {
  if (submit.name().size() > max_job_name) {
    return refuse(v1::Error::LIMIT, "a job's name of " + std::to_string(submit.name().size()) +
                                        " bytes is over the limit of " +
                                        std::to_string(max_job_name));
  }
  auto assets = hold(submit.scene_sha256(), submit.asset(), submit.backend());
  if (!assets) return tl::unexpected(assets.error());
  auto job = context_.queue.submit(std::move(submit), *std::move(assets), account_);
  if (!job) return tl::unexpected(job.error());
  context_.worker_of(**job).work();
  v1::Envelope envelope;
  envelope.mutable_submitted()->set_job_id((*job)->id());
  return envelope;
}

Dispatch::Answer Dispatch::watch(std::uint64_t request_id, const v1::Watch& watch) {
  const auto job = context_.queue.find(watch.job_id());
  if (!job) return no_such_job(watch.job_id());
  if (watches_.size() >= max_watches) {
    return refuse(v1::Error::LIMIT,
                  "a client may watch " + std::to_string(max_watches) + " jobs at a time");
  }
  watches_.add(request_id, watch, job);
  return std::nullopt;
}

Dispatch::Answer Dispatch::list() {
  v1::Envelope envelope;
  *envelope.mutable_job_list() = context_.queue.list();
  return envelope;
}

Dispatch::Answer Dispatch::order(Order order, std::uint64_t job_id) {
  const auto job = context_.queue.find(job_id);
  if (!job) return no_such_job(job_id);
  if (!account_->owns_server && job->owner() != account_)
    return refuse(v1::Error::NOT_FOUND, "job " + std::to_string(job_id) + " is another client's");
  const auto carry_out = [&]() -> tl::expected<void, Refusal> {
    switch (order) {
      case Order::cancel:
        return context_.queue.cancel(*job);
      case Order::pause:
        return context_.queue.pause(*job);
      case Order::resume:
        return context_.queue.resume(job);
    }
    return {};
  };
  if (auto done = carry_out(); !done) return tl::unexpected(done.error());
  Supervisor& worker = context_.worker_of(*job);
  if (order != Order::resume) worker.interrupt(*job);
  worker.work();
  v1::Envelope envelope;
  *envelope.mutable_job_summary() = job->summary();
  return envelope;
}

Dispatch::Answer Dispatch::open_view(std::uint64_t request_id, v1::OpenView open) {
  if (views_.size() >= max_session_views)
    return refuse(v1::Error::LIMIT, "a client may have " + std::to_string(max_session_views) +
                                        " views open at a time");
  auto assets = hold(open.scene_sha256(), open.asset(), open.backend());
  if (!assets) return tl::unexpected(assets.error());
  const auto view =
      context_.views.open(std::move(open), *std::move(assets), views_.wake(), account_);
  if (!view) return tl::unexpected(view.error());
  views_.add(request_id, *view);
  context_.worker_of((*view)->backend()).open(**view);
  return std::nullopt;
}

namespace {

tl::expected<View::Order, Refusal> order_of(View& view, const v1::UpdateView& update) {
  return view.update(update);
}

tl::expected<View::Order, Refusal> order_of(View& view, const v1::NextFrame&) {
  return view.next_frame();
}

tl::expected<View::Order, Refusal> order_of(View& view, const v1::CloseView&) {
  view.end({});
  return view.closing();
}

}  // namespace

template <class Request>
Dispatch::Answer Dispatch::tell_view(const Request& request) {
  const ViewPtr view = views_.find(request.view_id());
  if (!view)
    return refuse(v1::Error::NOT_FOUND, "there is no view " + std::to_string(request.view_id()));
  if (view->ended()) return std::nullopt;  // its last event is on the way
  auto order = order_of(*view, request);
  if (!order) return tl::unexpected(order.error());
  if (*order) context_.worker_of(view->backend()).tell(*std::move(*order));
  return std::nullopt;
}

}  // namespace metamer::service
