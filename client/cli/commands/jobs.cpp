#include "client/cli/commands.h"
#include "client/cli/connection.h"
#include "client/cli/named_job.h"
#include "client/cli/shared_options.h"
#include "client/session/record_job.h"
#include "client/tools/series/series_list.h"
#include "client/tools/series/series_run.h"
#include "client/tools/text/job_text.h"
#include "client/tools/text/record_text.h"

namespace metamer::cli {
namespace {

struct JobsOptions {
  CommonOptions common;
  bool mine = false;
  bool why = false;
  std::optional<std::string> series;  ///< Empty: each is opened.
  std::string record;                 ///< Of this job; empty: the list.
};

Json series_json(const ListedSeries& one) {
  return {{"handle", series_handle(one.series.id())},
          {"id", series_digits(one.series.id())},
          {"name", one.series.name()},
          {"user", one.user},
          {"count", one.series.count()},
          {"queued", one.queued},
          {"running", one.running},
          {"paused", one.paused},
          {"finished", one.finished},
          {"failed", one.failed},
          {"cancelled", one.cancelled},
          {"gone", one.gone},
          {"to_come", one.to_come}};
}

void list_job(const v1::JobSummary& job, const Session& session, bool why, Report& report) {
  report.line(describe(job, server_digits(session.welcome())));
  const std::string waits = why ? waiting_text(job) : std::string();
  if (!waits.empty()) report.line(std::string(18, ' ') + waits);
}

/// The jobs, with each series in one line, at its first job's place.
void list_closed(const v1::JobList& list, const std::vector<ListedSeries>& all,
                 const Session& session, bool why, Report& report) {
  std::size_t next = 0;
  for (const v1::JobSummary& job : list.job()) {
    if (!job.has_series()) list_job(job, session, why, report);
    const bool first = job.has_series() && next < all.size() &&
                       all[next].series.id() == job.series().id() && all[next].user == job.user();
    if (first) report.line(describe(all[next++]));
  }
}

/// Leaves the jobs of one series.
ExitCode keep_series(const std::vector<ListedSeries>& all, const std::string& word,
                     v1::JobList& list, Report& report) {
  const auto series = find_series(all, names_series(word) ? word : "series:" + word);
  if (!series) {
    report.error(series.error().message);
    return ExitCode::bad_input;
  }
  v1::JobList kept;
  for (const v1::JobSummary& job : list.job())
    if (job.user() == series->user && job.series().id() == series->series.id())
      *kept.add_job() = job;
  list = std::move(kept);
  return ExitCode::done;
}

boost::asio::awaitable<ExitCode> list_jobs(Session& session, const JobsOptions& options,
                                           Report& report) {
  Answer<v1::JobList> list = co_await session.list(options.mine);
  if (!list) co_return report.session_error(list.error());
  if (options.series && !options.series->empty()) {
    const ExitCode found = keep_series(listed_series(*list), *options.series, *list, report);
    if (found != ExitCode::done) co_return found;
  }
  const std::vector<ListedSeries> all = listed_series(*list);
  Json& series = report.document()["series"] = Json::array();
  for (const ListedSeries& one : all) series.push_back(series_json(one));
  report.document()["jobs"] = Json::array();
  for (const v1::JobSummary& job : list->job())
    report.document()["jobs"].push_back(job_json(job, session));
  if (!options.series) {
    list_closed(*list, all, session, options.why, report);
    co_return ExitCode::done;
  }
  for (const v1::JobSummary& job : list->job()) list_job(job, session, options.why, report);
  co_return ExitCode::done;
}

/// What ran a job that has finished, and what it did.
boost::asio::awaitable<ExitCode> show_record(Session& session, std::uint64_t job_id,
                                             Report& report) {
  const Answer<v1::JobList> list = co_await session.list();
  if (!list) co_return report.session_error(list.error());
  for (const v1::JobSummary& job : list->job()) {
    if (job.job_id() != job_id || has_ended(job)) continue;
    report.error("a job has its record once it has finished; this one is " +
                 std::string(word(job.state())));
    co_return ExitCode::bad_input;
  }
  const Answer<JobRecord> job = co_await record_job(session, job_id, JobParts::plan);
  if (!job) co_return report.session_error(job.error());
  if (!job->last.finished().has_record()) {
    report.error(
        "the job has no record: it did not finish, rendered nothing, or was rendered by a "
        "server that keeps none");
    co_return ExitCode::bad_input;
  }
  const v1::RunRecord& record = job->last.finished().record();
  report.document()["handle"] = to_text(job->job);
  report.document()["record"] = to_json(record);
  report.document()["timing"] = to_json(job->last.finished().timing());
  for (const std::string& line : record_lines(record)) report.line(line);
  co_return ExitCode::done;
}

ExitCode run(const JobsOptions& options) {
  Report report(options.common.json);
  if (!options.record.empty()) {
    const JobWork work = [&](Session& session, std::uint64_t job_id) {
      return show_record(session, job_id, report);
    };
    return report.finish(with_job(options.common, options.record, report, work));
  }
  return report.finish(with_server(options.common, report, [&](Session& session) {
    return list_jobs(session, options, report);
  }));
}

void declare(JobsOptions& values, Options& options) {
  options.push_back({.names = "--mine", .target = &values.mine, .meaning = "one's own alone"});
  options.push_back({.names = "--why",
                     .target = &values.why,
                     .meaning = "and what those wait for that do not run: others' turns, a quota, "
                                "memory, a worker"});
  options.push_back({.names = "--series",
                     .target = &values.series,
                     .meaning = "each job of a series by itself; of SERIES, its first bytes or its "
                                "name, no others",
                     .type = "[SERIES]",
                     .value_optional = true});
  options.push_back({.names = "--record",
                     .target = &values.record,
                     .meaning = "no list, but what ran this finished job, and what it did: builds, "
                                "machines, seconds by phase, rays",
                     .type = "JOB"});
  declare_common(values.common, options);
}

}  // namespace

Command commands::jobs() {
  return make_command<JobsOptions>("jobs", "list the jobs, a series of them in one line", declare,
                                   run);
}

}  // namespace metamer::cli
