#pragma once

#include <boost/asio/awaitable.hpp>
#include <cstdint>
#include <optional>

#include "client/cli/progress.h"
#include "client/cli/report.h"
#include "client/cli/scene_input.h"
#include "client/relight/factors.h"
#include "client/session/film.h"
#include "client/session/session.h"

namespace metamer::cli {

/// A job seen to its end.
struct Followed {
  std::uint64_t job_id = 0;
  v1::JobEvent last;  ///< finished, failed or cancelled
  std::optional<v1::Plan> plan;
  std::optional<Film> film;               ///< Where tiles were asked for and planned.
  std::optional<FactorsBuilder> factors;  ///< Where they were asked for and the job keeps them.
  bool factors_lost = false;              ///< There are more than the server keeps.
};

/// What of a job is asked for. Progress is shown of tiles, but for those that come quietly.
enum class Wanted { plan, tiles_quietly, tiles, tiles_and_factors };

/// Watches a job from its first event to its last, shows its progress, and puts its tiles together
/// where they are wanted.
boost::asio::awaitable<Answer<Followed>> follow(Session& session, std::uint64_t job_id,
                                                Wanted wanted);

/// Reports how the job ended: its plan and timing, notes, problems. `scene` locates them; null:
/// the scene is not at hand. Returns the exit code that the end means.
ExitCode conclude(const Followed& followed, const SceneInput* scene, Report& report);

}  // namespace metamer::cli
