#include "client/cli/commands/control.h"

#include "client/cli/connection.h"
#include "client/tools/text/job_text.h"

namespace metamer::cli {
namespace {

boost::asio::awaitable<ExitCode> control_job(Session& session, const ControlOptions& options,
                                             Report& report) {
  const Answer<v1::JobSummary> job = co_await (session.*options.request)(options.job_id);
  if (!job) co_return report.session_error(job.error());
  report.document()["job"] = to_json(*job);
  report.line(describe(*job));
  co_return ExitCode::done;
}

}  // namespace

void declare_control(ControlOptions& values, Options& options) {
  declare_job(values.job_id, options);
  declare_common(values.common, options);
}

ExitCode control(const ControlOptions& options) {
  Report report(options.common.json);
  return report.finish(with_server(options.common, report, [&](Session& session) {
    return control_job(session, options, report);
  }));
}

}  // namespace metamer::cli
