#pragma once

#include <boost/asio/awaitable.hpp>
#include <cstdint>

#include "client/cli/report.h"
#include "client/session/session.h"
#include "client/tools/scene/checked_scene.h"

namespace metamer::cli {

/// Whether the scene's backend keeps factors, where they are asked for; says why not.
bool check_factors(const Session& session, const CheckedScene& scene, bool keep_factors,
                   Report& report);

/// Submits a scene, and gives the job's number. Reports why there is none: the exit code, then. To
/// keep factors, the scene's backend must have them.
boost::asio::awaitable<tl::expected<std::uint64_t, ExitCode>> send_scene(Session& session,
                                                                         const CheckedScene& scene,
                                                                         bool keep_factors,
                                                                         Report& report);

}  // namespace metamer::cli
