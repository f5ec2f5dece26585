#include "client/cli/follow.h"

#include <cstdio>
#include <utility>

#include "common/scene/methods.h"

namespace metamer::cli {
namespace {

namespace asio = boost::asio;

Answer<void> take_planned(const v1::Planned& planned, Wanted wanted, Followed& followed) {
  followed.plan = planned.plan();
  if (wanted == Wanted::plan) return {};
  Answer<Film> film = Film::make(*followed.plan);
  if (!film) return tl::unexpected<SessionError>(std::move(film.error()));
  followed.film = std::move(*film);
  if (wanted != Wanted::tiles_and_factors || planned.factors().empty()) return {};
  v1::SceneFactors scene;
  if (!scene.ParseFromString(planned.factors()))
    return session_error(SessionError::Kind::disconnected, "the server sent factors of no scene");
  Result<FactorsBuilder> factors = FactorsBuilder::make(*followed.plan, scene);
  if (!factors)
    return session_error(SessionError::Kind::disconnected,
                         "the server's factors: " + factors.error().message);
  followed.factors = std::move(*factors);
  return {};
}

Answer<void> take_tile(const v1::Tile& tile, Followed& followed) {
  if (!followed.film)
    return session_error(SessionError::Kind::disconnected,
                         "the server sent a tile before its plan");
  if (Answer<void> added = followed.film->add(tile); !added) return added;
  if (!followed.factors) return {};
  if (tile.factors().empty()) {
    followed.factors.reset();
    followed.factors_lost = true;
    return {};
  }
  if (Result<void> added = followed.factors->add(tile); !added)
    return session_error(SessionError::Kind::disconnected,
                         "the server's factors: " + added.error().message);
  return {};
}

Answer<void> take(const v1::JobEvent& event, Wanted wanted, ProgressView& view,
                  Followed& followed) {
  if (wanted >= Wanted::tiles) view.show(event);
  switch (event.event_case()) {
    case v1::JobEvent::kPlanned:
      return take_planned(event.planned(), wanted, followed);
    case v1::JobEvent::kTile:
      return wanted == Wanted::plan ? Answer<void>() : take_tile(event.tile(), followed);
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
    case v1::JobEvent::kRetrying:  // from the start: the next plan makes a new film
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

/// What was promised beside what was measured.
ExitCode conclude_promise(const Followed& followed, Report& report) {
  const v1::Finished& finished = followed.last.finished();
  if (!followed.plan || !followed.plan->has_auto_() || !finished.has_accuracy())
    return ExitCode::done;
  const v1::Auto& goal = followed.plan->auto_();
  const v1::ColorError& error = finished.accuracy().error();
  report.document()["accuracy"] = to_json(finished.accuracy());

  char text[300];
  std::snprintf(
      text, sizeof text,
      "ΔE00 against the 1 nm reference, on %u pixels that had no part in the choice: mean "
      "%.3g, 95 %% below %.3g, at most %.3g",
      error.pixels(), error.mean(), error.percentile_95(), error.maximum());
  std::string said = text;
  if (goal.has_deadline())
    std::snprintf(text, sizeof text, "; it took %.3g s, and %.3g s were asked for",
                  finished.timing().total(), goal.deadline());
  else
    std::snprintf(text, sizeof text, "; at most %.3g was asked for", goal.tolerance());
  said += text;
  if (finished.accuracy().kept()) {
    report.note(
        {.field = {}, .file = {}, .message = method_text(followed.plan->method()) + ": " + said});
    return ExitCode::done;
  }
  report.error("the promise is broken by " + method_text(followed.plan->method()) + ": " + said);
  return ExitCode::promise_broken;
}

}  // namespace

asio::awaitable<Answer<Followed>> follow(Session& session, std::uint64_t job_id, Wanted wanted) {
  Followed followed;
  followed.job_id = job_id;
  v1::Watch request;
  request.set_job_id(job_id);
  const bool tiles = wanted != Wanted::plan;
  request.set_tiles(tiles);
  request.set_factors(wanted == Wanted::tiles_and_factors);

  {
    ProgressView view;
    Session::OnEvent on_event = [&](const v1::JobEvent& event) {
      return take(event, wanted, view, followed);
    };
    Answer<void> watched = co_await session.watch(request, on_event);
    if (!watched) co_return tl::unexpected<SessionError>(std::move(watched.error()));
  }

  // A picture with holes is no result.
  const bool finished = followed.last.event_case() == v1::JobEvent::kFinished;
  if (finished && followed.film && followed.last.finished().timing().rays() == 0 &&
      followed.film->missing() > 0)
    co_return session_error(SessionError::Kind::input,
                            "the job has no picture: it was checked or explained only");
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
      return conclude_promise(followed, report);
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
