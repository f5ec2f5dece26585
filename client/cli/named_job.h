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

/// Jobs that a person has named.
struct NamedJobs {
  std::vector<std::uint64_t> numbers;
  /// They come from a list, of a series, say: one of them may have ended, or be in another state,
  /// without a fault.
  bool listed = false;
};
using JobsWork = std::function<boost::asio::awaitable<ExitCode>(Session&, const NamedJobs&)>;

/// with_server, for a job that a person has named by its handle or number. What is neither, and
/// another server's job, is an error before anything is asked of the server.
ExitCode with_job(const CommonOptions& options, const std::string& named, Report& report,
                  const JobWork& work);
/// Of several each may be a series, too, as `jobs` lists it: its jobs that have not ended.
ExitCode with_jobs(const CommonOptions& options, const std::vector<std::string>& named,
                   Report& report, const JobsWork& work);

/// Whether nothing follows for the job.
bool has_ended(const v1::JobSummary& job);

/// An order to a job, which is answered with its new state.
using JobOrder = std::function<boost::asio::awaitable<Answer<v1::JobSummary>>(std::uint64_t)>;
/// Gives the order to each of the jobs, whatever becomes of each, and reports their new states. The
/// code is that of the first fault.
boost::asio::awaitable<ExitCode> order_each(Session& session, const NamedJobs& jobs,
                                            const JobOrder& order, Report& report);

/// A job's summary with its `handle`.
Json job_json(const v1::JobSummary& job, const Session& session);
/// An event with its job's `handle` and the `server_id`: a document of its own.
Json event_json(const v1::JobEvent& event, const Session& session);

}  // namespace metamer::cli
