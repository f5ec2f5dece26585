#pragma once

#include <functional>

#include "client/cli/connection.h"
#include "client/cli/progress.h"
#include "client/cli/report.h"
#include "client/tools/series/series_run.h"

namespace metamer::cli {

/// What turntable and sweep say of one of their jobs.
struct SeriesPart {
  std::uint32_t index = 0;
  std::string label;
  std::string failure;                      ///< Empty: it is done.
  std::optional<client::JobRecord> record;  ///< Of a job that was submitted.
};

/// What becomes of each job, as it ends; lines above the progress go to the view.
using TakePart = std::function<void(SeriesPart part, ProgressView& view)>;

/// What a series is made of.
struct SeriesPlan {
  client::SeriesJobs jobs;
  std::string noun;  ///< Of its jobs: "frames".
  std::function<Result<Submission>(std::uint32_t index)> make;
  std::function<std::string(std::uint32_t index)> label;
};

/// Runs a series to its end, with one line of progress on stderr; Ctrl-C cancels what was
/// submitted. Names each job that failed, with its reason, and what was measured of one that was
/// verified. Gives the code of the whole: job_failed where one has failed, cancelled, or no_server,
/// where those that were submitted go on there.
boost::asio::awaitable<ExitCode> follow_series(Session& session, Interrupts& interrupts,
                                               const SeriesPlan& plan, const TakePart& take,
                                               Report& report);

/// Why a job is not finished; empty: it is.
std::string failure_of(const client::SeriesEnd& end);

}  // namespace metamer::cli
