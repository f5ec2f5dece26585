#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "client/cli/connection.h"
#include "client/cli/json.h"
#include "client/session/job_handle.h"
#include "metamer/v1/jobs.pb.h"

namespace metamer::cli {

/// What a subcommand does with a job of a server, by its number there.
using JobWork = std::function<boost::asio::awaitable<ExitCode>(Session&, std::uint64_t job_id)>;
using JobsWork =
    std::function<boost::asio::awaitable<ExitCode>(Session&, const std::vector<std::uint64_t>&)>;

/// with_server, for a job that a person has named by its handle or number. What is neither, and
/// another server's job, is an error before anything is asked of the server.
ExitCode with_job(const CommonOptions& options, const std::string& named, Report& report,
                  const JobWork& work);
ExitCode with_jobs(const CommonOptions& options, const std::vector<std::string>& named,
                   Report& report, const JobsWork& work);

/// A job's summary with its `handle`.
Json job_json(const v1::JobSummary& job, const Session& session);
/// An event with its job's `handle` and the `server_id`: a document of its own.
Json event_json(const v1::JobEvent& event, const Session& session);

}  // namespace metamer::cli
