#include "client/cli/commands/control.h"

#include "client/cli/named_job.h"

namespace metamer::cli {
namespace {

boost::asio::awaitable<ExitCode> order_jobs(Session& session, Control request,
                                            const NamedJobs& jobs, Report& report) {
  const JobOrder order = [&](std::uint64_t id) { return (session.*request)(id); };
  co_return co_await order_each(session, jobs, order, report);
}

}  // namespace

void declare_control(ControlOptions& values, Options& options) {
  declare_jobs(values.job, options);
  declare_common(values.common, options);
}

ExitCode control(const ControlOptions& options) {
  Report report(options.common.json);
  const JobsWork work = [&](Session& session, const NamedJobs& jobs) {
    return order_jobs(session, options.request, jobs, report);
  };
  return report.finish(with_jobs(options.common, {options.job}, report, work));
}

}  // namespace metamer::cli
