#include "client/cli/commands/control.h"

#include "client/cli/named_job.h"
#include "client/tools/text/job_text.h"

namespace metamer::cli {
namespace {

boost::asio::awaitable<ExitCode> control_job(Session& session, Control request,
                                             std::uint64_t job_id, Report& report) {
  const Answer<v1::JobSummary> job = co_await (session.*request)(job_id);
  if (!job) co_return report.session_error(job.error());
  report.document()["job"] = job_json(*job, session);
  report.line(describe(*job, server_digits(session.welcome())));
  co_return ExitCode::done;
}

}  // namespace

void declare_control(ControlOptions& values, Options& options) {
  declare_job(values.job, options);
  declare_common(values.common, options);
}

ExitCode control(const ControlOptions& options) {
  Report report(options.common.json);
  return report.finish(
      with_job(options.common, options.job, report, [&](Session& session, std::uint64_t job_id) {
        return control_job(session, options.request, job_id, report);
      }));
}

}  // namespace metamer::cli
