#include "client/cli/commands.h"
#include "client/cli/named_job.h"
#include "client/cli/shared_options.h"
#include "client/tools/text/job_text.h"

namespace metamer::cli {
namespace {

struct PriorityOptions {
  CommonOptions common;
  std::string job;
  double priority = 0;  ///< A whole number, by its range.
};

boost::asio::awaitable<ExitCode> prioritize(Session& session, std::uint64_t job_id,
                                            std::int32_t priority, Report& report) {
  const Answer<v1::JobSummary> job = co_await session.prioritize(job_id, priority);
  if (!job) co_return report.session_error(job.error());
  report.document()["job"] = job_json(*job, session);
  report.line(describe(*job, server_digits(session.welcome())));
  co_return ExitCode::done;
}

ExitCode run(const PriorityOptions& options) {
  Report report(options.common.json);
  const auto priority = static_cast<std::int32_t>(options.priority);
  return report.finish(
      with_job(options.common, options.job, report, [&](Session& session, std::uint64_t job_id) {
        return prioritize(session, job_id, priority, report);
      }));
}

void declare(PriorityOptions& values, Options& options) {
  declare_job(values.job, options);
  options.push_back({.names = "priority",
                     .target = &values.priority,
                     .meaning = "-100 to 100: higher is first among one's own jobs",
                     .type = "INT",
                     .required = true,
                     .range = {{-100, 100}}});
  declare_common(values.common, options);
}

}  // namespace

Command commands::priority() {
  return make_command<PriorityOptions>("priority", "say which of one's own jobs come first",
                                       declare, run);
}

}  // namespace metamer::cli
