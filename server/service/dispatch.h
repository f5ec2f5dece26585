#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>

#include "metamer/v1/envelope.pb.h"
#include "server/service/asset_store.h"
#include "server/service/job_queue.h"
#include "server/service/refusal.h"
#include "server/service/supervisor.h"
#include "server/service/watches.h"

namespace metamer::service {

/// What every session works with. It outlives them all.
struct House {
  AssetStore& store;
  JobQueue& queue;
  Supervisor& cpu;
  Supervisor& gl;
  std::function<std::uint32_t()> sessions;  ///< How many there are.
  std::chrono::steady_clock::time_point started = std::chrono::steady_clock::now();

  Supervisor& worker_of(const Job& job) const {
    return job.submit().backend() == v1::GL ? gl : cpu;
  }
};

/// One client's side of the conversation: takes a request and gives the answer. No sockets.
class Dispatch {
 public:
  Dispatch(House& house, Watches& watches)
      : house_(house), watches_(watches), holds_(house.store) {}

  /// The answer to a request; nothing when it is answered by events alone, or not yet complete.
  std::optional<v1::Envelope> answer(v1::Envelope request);
  bool greeted() const { return greeted_; }

 private:
  using Answer = tl::expected<std::optional<v1::Envelope>, Refusal>;

  Answer dispatch(v1::Envelope& request);
  Answer hello(const v1::Hello& hello);
  Answer info();
  Answer offer(const v1::OfferAssets& offer);
  Answer chunk(const v1::AssetChunk& chunk);
  tl::expected<void, Refusal> take_chunk(const Digest& digest, const v1::AssetChunk& chunk);
  Answer submit(v1::Submit submit);
  Answer watch(std::uint64_t request_id, const v1::Watch& watch);
  Answer list();
  enum class Order { cancel, pause, resume };
  Answer order(Order order, std::uint64_t job_id);

  House& house_;
  Watches& watches_;
  bool greeted_ = false;
  AssetHolds holds_;  // what this client has offered, until it goes
  std::optional<AssetUpload> upload_;
};

}  // namespace metamer::service
