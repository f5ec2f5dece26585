#pragma once

#include <boost/asio/awaitable.hpp>
#include <cstdint>
#include <functional>
#include <optional>

#include "client/session/session.h"
#include "client/tools/tradeoff/tradeoff_steps.h"

/// Every method on one scene. All pictures are rendered by the same server, one after the other,
/// round by round: what else the machine does then slows all of them, and the minimum forgets it.
namespace metamer::client {

/// What a run tells as it goes, in the thread of the session. All of them are set.
struct TradeoffCalls {
  /// A round begins, from 1 on; as 0, that of the reference, which also warms the worker up.
  std::function<void(unsigned round, const Tradeoff& so_far)> round;
  /// A job is under way, which may be cancelled; nothing: no more.
  std::function<void(std::optional<std::uint64_t> job_id)> job;
  TradeoffMeasured measured;
};

/// Runs every case `rounds` times, 1 or more, and marks the front. A case that the server refuses
/// or that fails is a row with its reason. `scene` outlives it.
boost::asio::awaitable<tl::expected<Tradeoff, TradeoffStop>> run_tradeoff(
    Session& session, const TradeoffScene& scene, unsigned rounds, const TradeoffCalls& calls);

}  // namespace metamer::client
