#include "client/cli/commands.h"
#include "client/cli/named_job.h"
#include "client/cli/shared_options.h"
#include "client/tools/text/job_text.h"

namespace metamer::cli {
namespace {

struct CancelOptions {
  CommonOptions common;
  std::vector<std::string> jobs;
  bool all = false;
};

bool has_ended(const v1::JobSummary& job) {
  return job.state() != v1::QUEUED && job.state() != v1::RUNNING && job.state() != v1::PAUSED;
}

/// Cancels the jobs, whatever becomes of each; gives the first fault's code.
boost::asio::awaitable<ExitCode> cancel_each(Session& session, const CancelOptions& options,
                                             std::vector<std::uint64_t> jobs, Report& report) {
  ExitCode code = ExitCode::done;
  if (jobs.size() != 1 || options.all) report.document()["jobs"] = Json::array();
  for (const std::uint64_t id : jobs) {
    const Answer<v1::JobSummary> job = co_await session.cancel(id);
    if (!job) {
      // Of all, one may have ended since they were listed.
      const bool is_late = options.all && job.error().code == v1::Error::STATE;
      if (is_late) continue;
      const ExitCode fault = report.session_error(job.error());
      if (code == ExitCode::done) code = fault;
      if (session.lost()) break;
      continue;
    }
    if (report.document().contains("jobs"))
      report.document()["jobs"].push_back(job_json(*job, session));
    else
      report.document()["job"] = job_json(*job, session);
    report.line(describe(*job, server_digits(session.welcome())));
  }
  co_return code;
}

boost::asio::awaitable<ExitCode> cancel_jobs(Session& session, const CancelOptions& options,
                                             std::vector<std::uint64_t> jobs, Report& report) {
  if (options.all) {
    const Answer<v1::JobList> list = co_await session.list(true);
    if (!list) co_return report.session_error(list.error());
    for (const v1::JobSummary& job : list->job())
      if (!has_ended(job)) jobs.push_back(job.job_id());
  }
  co_return co_await cancel_each(session, options, std::move(jobs), report);
}

ExitCode run(const CancelOptions& options) {
  Report report(options.common.json);
  if (options.all != options.jobs.empty()) {
    report.error("cancel: name jobs by their handles or numbers, or all of one's own by --all");
    return report.finish(ExitCode::bad_input);
  }
  return report.finish(with_jobs(options.common, options.jobs, report,
                                 [&](Session& session, const std::vector<std::uint64_t>& jobs) {
                                   return cancel_jobs(session, options, jobs, report);
                                 }));
}

void declare(CancelOptions& values, Options& options) {
  options.push_back(
      {.names = "job", .target = &values.jobs, .meaning = "the jobs, by their handles or numbers"});
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
