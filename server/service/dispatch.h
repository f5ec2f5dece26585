#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>

#include "metamer/v1/envelope.pb.h"
#include "server/service/accounts.h"
#include "server/service/asset_store.h"
#include "server/service/job_queue.h"
#include "server/service/limits.h"
#include "server/service/refusal.h"
#include "server/service/supervisor.h"
#include "server/service/view_streams.h"
#include "server/service/watches.h"

namespace metamer::service {

/// What every session works with. It outlives them all.
struct ServiceContext {
  AssetStore& store;
  JobQueue& queue;
  Views& views;
  Supervisor& cpu;
  Supervisor& gl;
  std::function<std::uint32_t()> sessions;  ///< How many there are.
  Patience patience;
  Accounts accounts{};
  std::chrono::steady_clock::time_point started = std::chrono::steady_clock::now();

  Supervisor& worker_of(v1::Backend backend) const { return backend == v1::GL ? gl : cpu; }
  Supervisor& worker_of(const Job& job) const { return worker_of(job.submit().backend()); }
};

/// Answers one client's requests. Knows no sockets.
class Dispatch {
 public:
  Dispatch(ServiceContext& context, AccountPtr account, Watches& watches, ViewStreams& views)
      : context_(context),
        account_(std::move(account)),
        watches_(watches),
        views_(views),
        holds_(context.store, account_) {}

  /// The answer to a request; nothing when it is answered by events alone, or not yet complete.
  std::optional<v1::Envelope> answer(v1::Envelope request);
  bool greeted() const { return greeted_; }
  bool uploading() const { return upload_.has_value(); }
  /// The upload has to begin anew.
  void drop_upload() { upload_.reset(); }

 private:
  using Answer = tl::expected<std::optional<v1::Envelope>, Refusal>;

  Answer dispatch(v1::Envelope& request);
  Answer hello(const v1::Hello& hello);
  Answer info();
  Answer offer(const v1::OfferAssets& offer);
  Answer chunk(const v1::AssetChunk& chunk);
  tl::expected<void, Refusal> take_chunk(const Digest& digest, const v1::AssetChunk& chunk);
  using AssetNames = google::protobuf::RepeatedPtrField<v1::AssetName>;
  tl::expected<AssetHolds, Refusal> hold(const std::string& scene, const AssetNames& assets,
                                         v1::Backend backend);
  Answer submit(v1::Submit submit);
  Answer watch(std::uint64_t request_id, const v1::Watch& watch);
  Answer list();
  enum class Order { cancel, pause, resume };
  Answer order(Order order, std::uint64_t job_id);
  Answer open_view(std::uint64_t request_id, v1::OpenView open);
  template <class Request>
  Answer tell_view(const Request& request);

  ServiceContext& context_;
  AccountPtr account_;
  Watches& watches_;
  ViewStreams& views_;
  bool greeted_ = false;
  AssetHolds holds_;  // what this client has offered, until it goes
  std::optional<AssetUpload> upload_;
};

}  // namespace metamer::service
