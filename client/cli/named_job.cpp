#include "client/cli/named_job.h"

#include <utility>

namespace metamer::cli {
namespace {

boost::asio::awaitable<ExitCode> work_on(Session& session, const std::vector<JobHandle>& jobs,
                                         Report& report, const JobsWork& work) {
  std::vector<std::uint64_t> numbers;
  for (const JobHandle& job : jobs) {
    if (const Answer<void> known = check_server(job, session.welcome()); !known)
      co_return report.session_error(known.error());
    numbers.push_back(job.number);
  }
  co_return co_await work(session, numbers);
}

void add_handle(std::uint64_t number, const Session& session, Json& object) {
  object["handle"] = to_text({number, server_digits(session.welcome())});
}

}  // namespace

ExitCode with_jobs(const CommonOptions& options, const std::vector<std::string>& named,
                   Report& report, const JobsWork& work) {
  std::vector<JobHandle> jobs;
  for (const std::string& one : named) {
    Result<JobHandle> job = parse_job_handle(one);
    if (!job) {
      report.error(job.error().message);
      return ExitCode::bad_input;
    }
    jobs.push_back(*std::move(job));
  }
  return with_server(options, report,
                     [&](Session& session) { return work_on(session, jobs, report, work); });
}

ExitCode with_job(const CommonOptions& options, const std::string& named, Report& report,
                  const JobWork& work) {
  return with_jobs(options, {named}, report,
                   [&](Session& session, const std::vector<std::uint64_t>& numbers) {
                     return work(session, numbers.front());
                   });
}

Json job_json(const v1::JobSummary& job, const Session& session) {
  Json object = to_json(job);
  add_handle(job.job_id(), session, object);
  return object;
}

Json event_json(const v1::JobEvent& event, const Session& session) {
  Json object = to_json(event);
  add_handle(event.job_id(), session, object);
  const std::string server = server_digits(session.welcome());
  if (!server.empty()) object["server_id"] = server;
  return object;
}

}  // namespace metamer::cli
