#include "client/cli/follow.h"

#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>

#include "client/cli/progress.h"
#include "client/session/problems.h"
#include "client/tools/text/promise_text.h"
#include "common/printable.h"

namespace metamer::cli {
namespace {

ExitCode conclude_failed(const v1::Failed& failed, const CheckedScene* scene, Report& report) {
  const bool bad_input = failed.kind() == v1::Failed::BAD_INPUT;
  if (!bad_input || failed.problem().empty())
    report.error(failed.reason().empty() ? "the job failed"
                                         : "the job failed: " + printable(failed.reason()));
  const std::vector<Problem> problems = from_wire(failed.problem());
  if (scene) {
    report_problems(*scene, problems, report);
  } else {
    for (const Problem& one : problems) report.problem(one);
  }
  return bad_input ? ExitCode::bad_input : ExitCode::job_failed;
}

/// What was measured, beside what was promised.
ExitCode conclude_promise(const JobRecord& job, Report& report) {
  const v1::Finished& finished = job.last.finished();
  const auto promise = job.plan ? promise_text(*job.plan, finished) : std::nullopt;
  if (!promise) return ExitCode::done;
  report.document()["accuracy"] = to_json(finished.accuracy());
  if (promise->kept) {
    report.note({.field = {}, .file = {}, .message = promise->text});
    return ExitCode::done;
  }
  report.error("the promise is broken by " + promise->text);
  return ExitCode::promise_broken;
}

}  // namespace

boost::asio::awaitable<Answer<JobRecord>> follow(Session& session, std::uint64_t job_id,
                                                 JobParts parts) {
  if (parts == JobParts::plan) co_return co_await record_job(session, job_id, parts);
  ProgressView view;
  const std::function<void(const v1::JobEvent&)> show = [&](const v1::JobEvent& event) {
    view.show(event);
  };
  co_return co_await record_job(session, job_id, parts, show);
}

void request_cancel(const boost::asio::any_io_executor& executor, Session& session,
                    std::uint64_t job_id) {
  boost::asio::co_spawn(executor, session.cancel(job_id), boost::asio::detached);
}

ExitCode conclude(const JobRecord& job, const CheckedScene* scene, Report& report) {
  Json& document = report.document();
  document["job_id"] = job.job.number;
  document["handle"] = to_text(job.job);
  if (job.plan) {
    document["plan"] = to_json(*job.plan);
    for (const v1::Notice& notice : job.plan->notice()) {
      if (scene) {
        report_notice(*scene, notice, report);
      } else {
        Problem note;
        note.field = notice.field();
        note.message =
            notice.field().empty() ? notice.message() : notice.field() + ": " + notice.message();
        report.note(note);
      }
    }
  }
  switch (job.last.event_case()) {
    case v1::JobEvent::kFinished:
      document["state"] = "finished";
      document["timing"] = to_json(job.last.finished().timing());
      if (job.last.finished().has_record())
        document["record"] = to_json(job.last.finished().record());
      return conclude_promise(job, report);
    case v1::JobEvent::kFailed:
      document["state"] = "failed";
      return conclude_failed(job.last.failed(), scene, report);
    default:
      document["state"] = "cancelled";
      report.error("cancelled");
      return ExitCode::cancelled;
  }
}

}  // namespace metamer::cli
