#include "client/cli/named_job.h"

#include <utility>

#include "client/tools/series/series_list.h"
#include "client/tools/series/series_run.h"
#include "client/tools/text/job_text.h"

namespace metamer::cli {
namespace {

/// A word, read.
struct NamedWord {
  std::string word;
  JobHandle job;  ///< Where it is no series'.
};

/// Adds the jobs of a series that have not ended.
boost::asio::awaitable<ExitCode> add_series(Session& session, const std::string& word,
                                            NamedJobs& jobs, Report& report) {
  const Answer<v1::JobList> list = co_await session.list();
  if (!list) co_return report.session_error(list.error());
  const auto series = find_series(listed_series(*list), word);
  if (!series) {
    report.error(series.error().message);
    co_return ExitCode::bad_input;
  }
  const std::size_t before = jobs.numbers.size();
  for (const v1::JobSummary& job : list->job())
    if (job.user() == series->user && job.series().id() == series->series.id() && !has_ended(job))
      jobs.numbers.push_back(job.job_id());
  if (jobs.numbers.size() == before) {
    report.error("all jobs of " + series_handle(series->series.id()) + " have ended");
    co_return ExitCode::bad_input;
  }
  jobs.listed = true;
  co_return ExitCode::done;
}

boost::asio::awaitable<ExitCode> work_on(Session& session, const std::vector<NamedWord>& named,
                                         Report& report, const JobsWork& work) {
  NamedJobs jobs;
  for (const NamedWord& one : named) {
    if (names_series(one.word)) {
      const ExitCode found = co_await add_series(session, one.word, jobs, report);
      if (found != ExitCode::done) co_return found;
      continue;
    }
    if (const Answer<void> known = check_server(one.job, session.welcome()); !known)
      co_return report.session_error(known.error());
    jobs.numbers.push_back(one.job.number);
  }
  co_return co_await work(session, jobs);
}

void add_handle(std::uint64_t number, const Session& session, Json& object) {
  object["handle"] = to_text({number, server_digits(session.welcome())});
}

}  // namespace

ExitCode with_jobs(const CommonOptions& options, const std::vector<std::string>& named,
                   Report& report, const JobsWork& work) {
  std::vector<NamedWord> words;
  for (const std::string& one : named) {
    if (names_series(one)) {
      words.push_back({one, {}});
      continue;
    }
    Result<JobHandle> job = parse_job_handle(one);
    if (!job) {
      report.error(job.error().message);
      return ExitCode::bad_input;
    }
    words.push_back({one, *std::move(job)});
  }
  return with_server(options, report,
                     [&](Session& session) { return work_on(session, words, report, work); });
}

ExitCode with_job(const CommonOptions& options, const std::string& named, Report& report,
                  const JobWork& work) {
  if (names_series(named)) {
    report.error(quoted(named) +
                 " is a series of jobs, and this takes one: metamer jobs --series " + named +
                 " lists them");
    return ExitCode::bad_input;
  }
  const JobsWork work_on_one = [&](Session& session, const NamedJobs& jobs) {
    return work(session, jobs.numbers.front());
  };
  return with_jobs(options, {named}, report, work_on_one);
}

bool has_ended(const v1::JobSummary& job) {
  return job.state() != v1::QUEUED && job.state() != v1::RUNNING && job.state() != v1::PAUSED;
}

boost::asio::awaitable<ExitCode> order_each(Session& session, const NamedJobs& jobs,
                                            const JobOrder& order, Report& report) {
  ExitCode code = ExitCode::done;
  const bool several = jobs.numbers.size() != 1 || jobs.listed;
  if (several) report.document()["jobs"] = Json::array();
  for (const std::uint64_t id : jobs.numbers) {
    const Answer<v1::JobSummary> job = co_await order(id);
    if (!job) {
      const bool is_late = jobs.listed && job.error().code == v1::Error::STATE;
      if (is_late) continue;
      const ExitCode fault = report.session_error(job.error());
      if (code == ExitCode::done) code = fault;
      if (session.lost()) break;
      continue;
    }
    if (several)
      report.document()["jobs"].push_back(job_json(*job, session));
    else
      report.document()["job"] = job_json(*job, session);
    report.line(describe(*job, server_digits(session.welcome())));
  }
  co_return code;
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
