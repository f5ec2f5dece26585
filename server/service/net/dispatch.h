#pragma once

#include <boost/asio.hpp>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "metamer/v1/envelope.pb.h"
#include "server/service/access/accounts.h"
#include "server/service/access/identity.h"
#include "server/service/access/known_assets.h"
#include "server/service/access/logins.h"
#include "server/service/assets/asset_store.h"
#include "server/service/executors/executor.h"
#include "server/service/jobs/job_queue.h"
#include "server/service/limits.h"
#include "server/service/net/traffic.h"
#include "server/service/net/view_streams.h"
#include "server/service/net/watches.h"
#include "server/service/refusal.h"

namespace metamer::service {

/// What every session works with. It outlives them all.
struct ServiceContext {
  AssetStore& store;
  JobQueue& queue;
  Views& views;
  Executor& cpu;
  Executor& cpu_views;
  Executor& gl;
  ViewHost& cpu_view_host;
  ViewHost& gl_view_host;
  std::function<std::uint32_t()> sessions;  ///< How many there are.
  const Limits& limits;
  const Patience& patience;
  Logins& logins;
  Accounts accounts;
  JobStore* state = nullptr;  ///< Where jobs are kept; none: they end with the daemon.
  bool closing = false;       ///< The server ends: no more jobs and views.
  Traffic traffic{};
  KnownAssets known_assets{};
  /// What users, sessions and counts this one may hear of.
  std::function<void(const Identity&, v1::Info&)> tell_usage = {};
  std::chrono::steady_clock::time_point started = std::chrono::steady_clock::now();

  Executor& executor_of(const Job& job) const {
    return job.submit().backend() == v1::GL ? gl : cpu;
  }
  ViewHost& host_of(const View& view) const {
    return view.backend() == v1::GL ? gl_view_host : cpu_view_host;
  }
};

/// Answers one client's requests. Knows no sockets.
class Dispatch {
 public:
  /// Says who a client is that has said this token, and gives it a place.
  using Admit = std::function<tl::expected<Identity, Refusal>(const std::string& token)>;
  Dispatch(ServiceContext& context, Admit admit, Watches& watches, ViewStreams& views)
      : context_(context), admit_(std::move(admit)), watches_(watches), views_(views) {}

  /// The answer to a request; nothing when it is answered by events alone, or not yet complete.
  /// What an answer promises is on the disk before. One request at a time.
  asio::awaitable<std::optional<v1::Envelope>> answer(v1::Envelope request);
  bool greeted() const { return identity_.has_value(); }
  /// Once greeted.
  const Identity& identity() const { return *identity_; }
  const AccountPtr& account() const { return account_; }
  const std::string& client() const { return client_; }
  bool uploading() const { return upload_.has_value(); }
  /// The upload has to begin anew.
  void drop_upload() { upload_.reset(); }

 private:
  using Answer = tl::expected<std::optional<v1::Envelope>, Refusal>;

  asio::awaitable<Answer> dispatch(v1::Envelope& request);
  std::vector<Digest> named_assets(const v1::Envelope& request) const;
  Answer hello(const v1::Hello& hello);
  Answer info();
  bool may_know(const Digest& digest) const;
  Answer offer(const v1::OfferAssets& offer);
  asio::awaitable<Answer> chunk(const v1::AssetChunk& chunk);
  asio::awaitable<tl::expected<void, Refusal>> store(AssetUpload upload);
  asio::awaitable<std::optional<Refusal>> kept(const Job& job);
  tl::expected<void, Refusal> take_chunk(const Digest& digest, const v1::AssetChunk& chunk);
  using AssetNames = google::protobuf::RepeatedPtrField<v1::AssetName>;
  tl::expected<AssetHolds, Refusal> hold(const std::string& scene, const AssetNames& assets,
                                         v1::Backend backend);
  asio::awaitable<Answer> submit(v1::Submit submit);
  asio::awaitable<Answer> prioritize(const v1::Prioritize& request);
  Answer watch(std::uint64_t request_id, const v1::Watch& watch);
  Answer unwatch(const v1::Unwatch& unwatch);
  Answer list(const v1::ListJobs& request);
  bool sees(const Job& job) const;
  tl::expected<JobQueue::JobPtr, Refusal> own_job(std::uint64_t id) const;
  enum class Order { cancel, pause, resume };
  asio::awaitable<Answer> order(Order order, std::uint64_t job_id);
  Answer open_view(std::uint64_t request_id, v1::OpenView open);
  tl::expected<View::Order, Refusal> update(View& view, const v1::UpdateView& update);
  Answer tell_view(std::uint64_t view_id,
                   const std::function<tl::expected<View::Order, Refusal>(View&)>& ask);

  ServiceContext& context_;
  Admit admit_;
  Watches& watches_;
  ViewStreams& views_;
  std::optional<Identity> identity_;  // from Hello on, as all below
  AccountPtr account_;
  std::string client_;               // its own words
  std::optional<AssetHolds> holds_;  // what this client has offered, until it goes
  std::optional<AssetUpload> upload_;
};

}  // namespace metamer::service
