#include "client/cli/commands.h"
#include "client/cli/connection.h"
#include "client/cli/shared_options.h"
#include "client/tools/text/job_text.h"

namespace metamer::cli {
namespace {

struct PriorityOptions {
  CommonOptions common;
  std::uint64_t job_id = 0;
  double priority = 0;  ///< A whole number, by its range.
};

boost::asio::awaitable<ExitCode> prioritize(Session& session, const PriorityOptions& options,
                                            Report& report) {
  const Answer<v1::JobSummary> job =
      co_await session.prioritize(options.job_id, static_cast<std::int32_t>(options.priority));
  if (!job) co_return report.session_error(job.error());
  report.document()["job"] = to_json(*job);
  report.line(describe(*job));
  co_return ExitCode::done;
}

ExitCode run(const PriorityOptions& options) {
  Report report(options.common.json);
  return report.finish(with_server(options.common, report, [&](Session& session) {
    return prioritize(session, options, report);
  }));
}

void declare(PriorityOptions& values, Options& options) {
  declare_job(values.job_id, options);
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
