#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/awaitable.hpp>
#include <cstdint>

#include "client/cli/report.h"
#include "client/cli/scene_input.h"
#include "client/session/record_job.h"
#include "client/session/session.h"

namespace metamer::cli {

/// record_job, with the job's progress on stderr where its picture is kept.
boost::asio::awaitable<Answer<JobRecord>> follow(Session& session, std::uint64_t job_id,
                                                 JobParts parts);

/// Asks for the job's end, and waits for no answer: the watched stream tells how it ended.
void request_cancel(const boost::asio::any_io_executor& executor, Session& session,
                    std::uint64_t job_id);

/// Reports how the job ended: its plan and timing, notes, problems. `scene` locates them; null:
/// the scene is not at hand. Returns the exit code that the end means.
ExitCode conclude(const JobRecord& job, const CheckedScene* scene, Report& report);

}  // namespace metamer::cli
