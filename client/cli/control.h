#pragma once

#include <cstdint>

#include "client/cli/exit_code.h"
#include "client/cli/options.h"
#include "client/cli/report.h"
#include "client/session/session.h"

namespace metamer::cli {

/// What cancel, pause and resume have in common: one request, answered with the job's new state.
using Control = boost::asio::awaitable<Answer<v1::JobSummary>> (Session::*)(std::uint64_t);
ExitCode control(const ControlOptions& options, Control request);

}  // namespace metamer::cli
