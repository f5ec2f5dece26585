#pragma once

#include <boost/asio/awaitable.hpp>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "client/session/session.h"
#include "client/tools/tradeoff/tradeoff.h"
#include "common/image/image.h"
#include "common/scene/scene_file.h"

/// Every method on one scene. All pictures are rendered by the same server, one after the other,
/// round by round: what else the machine does then slows all of them, and the minimum forgets it.
namespace metamer::client {

/// A sound scene, whose settings name no method that would count.
struct TradeoffScene {
  const v1::Scene& scene;
  const std::vector<Asset>& assets;
  std::string name;
};

/// What a run tells as it goes, in the thread of the session. All of them are set.
struct TradeoffCalls {
  /// A round begins, from 1 on; as 0, that of the reference, which also warms the worker up.
  std::function<void(unsigned round, const Tradeoff& so_far)> round;
  /// A job is under way, which may be cancelled; nothing: no more.
  std::function<void(std::optional<std::uint64_t> job_id)> job;
  /// A row was measured in its first round; the picture is its difference from the reference,
  /// drawn by false_color. An error ends the run.
  std::function<Result<void>(const TradeoffRow& row, const Image& difference)> measured;
};

/// Why a run came to no end.
struct TradeoffStop {
  enum class Kind {
    session,    ///< `error` says why.
    cancelled,  ///< One of its jobs was.
    reference,  ///< It can't be rendered: problem.message says why.
    picture,    ///< `problem`, by `measured`, or pictures that do not compare.
  };
  Kind kind = Kind::cancelled;
  SessionError error = {};
  Problem problem = {};
};

/// Runs every case `rounds` times, 1 or more, and marks the front. A case that the server refuses
/// or that fails is a row with its reason. `scene` outlives it.
boost::asio::awaitable<tl::expected<Tradeoff, TradeoffStop>> run_tradeoff(
    Session& session, const TradeoffScene& scene, unsigned rounds, const TradeoffCalls& calls);

/// A perfect white that faces the dominant light, of the light's luminance. Nothing where the plan
/// has no white of it.
std::optional<Xyz> lit_white(const v1::Plan& plan, const v1::Scene& scene);

}  // namespace metamer::client
