#include "client/cli/follow.h"

#include <utility>

namespace metamer::cli {
namespace {

namespace asio = boost::asio;

Answer<void> take(const v1::JobEvent& event, bool tiles, ProgressView& view, Followed& followed) {
  view.show(event);
  switch (event.event_case()) {
    case v1::JobEvent::kPlanned:
      followed.plan = event.planned().plan();
      if (tiles) {
        Answer<Film> film = Film::make(*followed.plan);
        if (!film) return tl::unexpected<SessionError>(std::move(film.error()));
        followed.film = std::move(*film);
      }
      return {};
    case v1::JobEvent::kTile:
      if (!tiles) return {};
      if (!followed.film)
        return session_error(SessionError::Kind::disconnected,
                             "the server sent a tile before its plan");
      return followed.film->add(event.tile());
    case v1::JobEvent::kFinished:
    case v1::JobEvent::kFailed:
    case v1::JobEvent::kCancelled:
      followed.last = event;
      return {};
    case v1::JobEvent::kQueued:
    case v1::JobEvent::kStarted:
    case v1::JobEvent::kProgress:
    case v1::JobEvent::kPreview:
    case v1::JobEvent::kPaused:
    case v1::JobEvent::kRetrying:
    case v1::JobEvent::EVENT_NOT_SET:
      return {};
  }
  return {};
}

ExitCode conclude_failed(const v1::Failed& failed, const SceneInput* scene, Report& report) {
  const bool bad_input = failed.kind() == v1::Failed::BAD_INPUT;
  if (!bad_input || failed.problem().empty())
    report.error(failed.reason().empty() ? "the job failed" : "the job failed: " + failed.reason());
  std::vector<Problem> problems;
  for (const v1::Problem& one : failed.problem()) problems.push_back(from_wire(one));
  if (scene) {
    scene->print_all(problems, report);
  } else {
    for (const Problem& one : problems) report.problem(one, {});
  }
  return bad_input ? ExitCode::bad_input : ExitCode::job_failed;
}

}  // namespace

asio::awaitable<Answer<Followed>> follow(Session& session, std::uint64_t job_id, bool tiles) {
  Followed followed;
  followed.job_id = job_id;
  v1::Watch request;
  request.set_job_id(job_id);
  request.set_tiles(tiles);

  {
    ProgressView view;
    Session::OnEvent on_event = [&](const v1::JobEvent& event) {
      return take(event, tiles, view, followed);
    };
    Answer<void> watched = co_await session.watch(request, on_event);
    if (!watched) co_return tl::unexpected<SessionError>(std::move(watched.error()));
  }

  // A picture with holes is no result.
  const bool finished = followed.last.event_case() == v1::JobEvent::kFinished;
  if (finished && tiles && (!followed.film || !followed.film->complete()))
    co_return session_error(SessionError::Kind::disconnected,
                            "the server finished the job without all of its tiles");
  co_return Answer<Followed>(std::move(followed));
}

ExitCode conclude(const Followed& followed, const SceneInput* scene, Report& report) {
  Json& document = report.document();
  document["job_id"] = followed.job_id;
  if (followed.plan) {
    document["plan"] = to_json(*followed.plan);
    for (const v1::Notice& notice : followed.plan->notice()) {
      if (scene) {
        scene->print(notice, report);
      } else {
        Problem note;
        note.field = notice.field();
        note.message =
            notice.field().empty() ? notice.message() : notice.field() + ": " + notice.message();
        report.note(note);
      }
    }
  }
  switch (followed.last.event_case()) {
    case v1::JobEvent::kFinished:
      document["state"] = "finished";
      document["timing"] = to_json(followed.last.finished().timing());
      return ExitCode::done;
    case v1::JobEvent::kFailed:
      document["state"] = "failed";
      return conclude_failed(followed.last.failed(), scene, report);
    default:
      document["state"] = "cancelled";
      report.error("cancelled");
      return ExitCode::cancelled;
  }
}

}  // namespace metamer::cli
