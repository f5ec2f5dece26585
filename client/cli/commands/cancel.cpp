#include "client/cli/commands.h"
#include "client/cli/named_job.h"
#include "client/cli/shared_options.h"

namespace metamer::cli {
namespace {

struct CancelOptions {
  CommonOptions common;
  std::vector<std::string> jobs;
  bool all = false;
};

boost::asio::awaitable<ExitCode> cancel_jobs(Session& session, const CancelOptions& options,
                                             NamedJobs jobs, Report& report) {
  if (options.all) {
    const Answer<v1::JobList> list = co_await session.list(true);
    if (!list) co_return report.session_error(list.error());
    for (const v1::JobSummary& job : list->job())
      if (!has_ended(job)) jobs.numbers.push_back(job.job_id());
    jobs.listed = true;
  }
  const JobOrder order = [&](std::uint64_t id) { return session.cancel(id); };
  co_return co_await order_each(session, jobs, order, report);
}

ExitCode run(const CancelOptions& options) {
  Report report(options.common.json);
  if (options.all != options.jobs.empty()) {
    report.error("cancel: name jobs by their handles or numbers, or all of one's own by --all");
    return report.finish(ExitCode::bad_input);
  }
  return report.finish(
      with_jobs(options.common, options.jobs, report, [&](Session& session, const NamedJobs& jobs) {
        return cancel_jobs(session, options, jobs, report);
      }));
}

void declare(CancelOptions& values, Options& options) {
  options.push_back({.names = "job",
                     .target = &values.jobs,
                     .meaning = "the jobs, by their handles or numbers, or a series of them"});
  options.push_back(
      {.names = "--all", .target = &values.all, .meaning = "all of one's own that have not ended"});
  declare_common(values.common, options);
}

}  // namespace

Command commands::cancel() {
  return make_command<CancelOptions>("cancel", "end jobs and drop what they rendered", declare,
                                     run);
}

}  // namespace metamer::cli
