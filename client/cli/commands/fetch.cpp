#include "client/cli/commands.h"
#include "client/cli/development.h"
#include "client/cli/follow.h"
#include "client/cli/named_job.h"
#include "client/cli/output/output.h"
#include "client/cli/shared_options.h"

namespace metamer::cli {
namespace {

struct FetchOptions {
  CommonOptions common;
  std::string job;
  OutputOptions output;
  DevelopmentOptions development;  ///< In place of what the job was submitted with.
};

/// The name that the job was submitted under, for the pictures' metadata.
boost::asio::awaitable<Answer<std::string>> job_name(Session& session, std::uint64_t job_id) {
  const Answer<v1::JobList> list = co_await session.list();
  if (!list) co_return tl::unexpected<SessionError>(list.error());
  for (const v1::JobSummary& job : list->job())
    if (job.job_id() == job_id) co_return job.name();
  co_return std::string();
}

boost::asio::awaitable<ExitCode> fetch_from(Session& session, std::uint64_t job_id,
                                            const FetchOptions& options, Report& report) {
  const Answer<std::string> name = co_await job_name(session, job_id);
  if (!name) co_return report.session_error(name.error());
  Answer<JobRecord> job = co_await follow(session, job_id, wanted(options.output));
  if (!job) co_return report.session_error(job.error());
  const ExitCode code = conclude(*job, nullptr, report);
  if (code != ExitCode::done && code != ExitCode::promise_broken) co_return code;
  // The words were checked before the job was.
  (void)apply(options.development, *job->plan->mutable_development());
  const ExitCode written = write_output(options.output, *job, *name, report);
  co_return written == ExitCode::done ? code : written;
}

ExitCode run(const FetchOptions& options) {
  Report report(options.common.json);
  const ExitCode fit = check_output(options.output, report);
  if (fit != ExitCode::done) return report.finish(fit);
  v1::Development checked;
  if (const auto words = apply(options.development, checked); !words) {
    report.error(words.error().message);
    return report.finish(ExitCode::bad_input);
  }
  return report.finish(
      with_job(options.common, options.job, report, [&](Session& session, std::uint64_t job_id) {
        return fetch_from(session, job_id, options, report);
      }));
}

void declare(FetchOptions& values, Options& options) {
  declare_job(values.job, options);
  declare_output(values.output, options);
  declare_development(values.development, "In place of what the job says", options);
  declare_common(values.common, options);
}

}  // namespace

Command commands::fetch() {
  return make_command<FetchOptions>("fetch", "wait for a job and write its picture", declare, run);
}

}  // namespace metamer::cli
