#include "client/cli/control.h"

#include "client/cli/connection.h"
#include "client/tools/job_text.h"

namespace metamer::cli {
namespace {

boost::asio::awaitable<ExitCode> control_job(Session& session, std::uint64_t job_id,
                                             Control request, Report& report) {
  const Answer<v1::JobSummary> job = co_await (session.*request)(job_id);
  if (!job) co_return report.session_error(job.error());
  report.document()["job"] = to_json(*job);
  report.line(describe(*job));
  co_return ExitCode::done;
}

}  // namespace

ExitCode control(const ControlOptions& options, Control request) {
  Report report(options.common.json);
  return report.finish(with_server(options.common, report, [&](Session& session) {
    return control_job(session, options.job_id, request, report);
  }));
}

}  // namespace metamer::cli
