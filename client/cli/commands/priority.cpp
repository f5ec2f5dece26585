#include "client/cli/commands.h"
#include "client/cli/named_job.h"
#include "client/cli/shared_options.h"

namespace metamer::cli {
namespace {

struct PriorityOptions {
  CommonOptions common;
  std::string job;
  double priority = 0;  ///< A whole number, by its range.
};

boost::asio::awaitable<ExitCode> prioritize(Session& session, const NamedJobs& jobs,
                                            std::int32_t priority, Report& report) {
  const JobOrder order = [&](std::uint64_t id) { return session.prioritize(id, priority); };
  co_return co_await order_each(session, jobs, order, report);
}

ExitCode run(const PriorityOptions& options) {
  Report report(options.common.json);
  const auto priority = static_cast<std::int32_t>(options.priority);
  const JobsWork work = [&](Session& session, const NamedJobs& jobs) {
    return prioritize(session, jobs, priority, report);
  };
  return report.finish(with_jobs(options.common, {options.job}, report, work));
}

void declare(PriorityOptions& values, Options& options) {
  declare_jobs(values.job, options);
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
