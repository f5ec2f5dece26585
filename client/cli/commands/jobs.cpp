#include "client/cli/commands.h"
#include "client/cli/connection.h"
#include "client/cli/named_job.h"
#include "client/cli/shared_options.h"
#include "client/tools/text/job_text.h"

namespace metamer::cli {
namespace {

struct JobsOptions {
  CommonOptions common;
  bool mine = false;
  bool why = false;
};

boost::asio::awaitable<ExitCode> list_jobs(Session& session, const JobsOptions& options,
                                           Report& report) {
  const Answer<v1::JobList> list = co_await session.list(options.mine);
  if (!list) co_return report.session_error(list.error());
  report.document()["jobs"] = Json::array();
  for (const v1::JobSummary& job : list->job()) {
    report.document()["jobs"].push_back(job_json(job, session));
    report.line(describe(job, server_digits(session.welcome())));
    const std::string waits = options.why ? waiting_text(job) : std::string();
    if (!waits.empty()) report.line(std::string(18, ' ') + waits);
  }
  co_return ExitCode::done;
}

ExitCode run(const JobsOptions& options) {
  Report report(options.common.json);
  return report.finish(with_server(options.common, report, [&](Session& session) {
    return list_jobs(session, options, report);
  }));
}

void declare(JobsOptions& values, Options& options) {
  options.push_back({.names = "--mine", .target = &values.mine, .meaning = "one's own alone"});
  options.push_back({.names = "--why",
                     .target = &values.why,
                     .meaning = "and what those wait for that do not run: others' turns, a quota, "
                                "memory, a worker"});
  declare_common(values.common, options);
}

}  // namespace

Command commands::jobs() {
  return make_command<JobsOptions>("jobs", "list the jobs", declare, run);
}

}  // namespace metamer::cli
