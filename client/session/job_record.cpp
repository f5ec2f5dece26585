#include "client/session/job_record.h"

#include <utility>

namespace metamer::client {
namespace {

using Kind = SessionError::Kind;

Answer<void> take_planned(const v1::Planned& planned, JobParts parts, JobRecord& record) {
  record.plan = planned.plan();
  if (parts == JobParts::plan) return {};
  Answer<Film> film = Film::make(*record.plan);
  if (!film) return tl::unexpected<SessionError>(std::move(film.error()));
  record.film = std::move(*film);
  if (parts != JobParts::picture_and_factors || planned.factors().empty()) return {};
  v1::SceneFactors scene;
  if (!scene.ParseFromString(planned.factors()))
    return session_error(Kind::disconnected, "the server sent factors of no scene");
  Result<FactorsBuilder> factors = FactorsBuilder::make(*record.plan, scene);
  if (!factors)
    return session_error(Kind::disconnected, "the server's factors: " + factors.error().message);
  record.factors = std::move(*factors);
  return {};
}

Answer<void> take_tile(const v1::Tile& tile, JobRecord& record) {
  if (!record.film)
    return session_error(Kind::disconnected, "the server sent a tile before its plan");
  if (Answer<void> added = record.film->add(tile); !added) return added;
  if (!record.factors) return {};
  if (tile.factors().empty()) {
    record.factors.reset();
    record.factors_lost = true;
    return {};
  }
  if (Result<void> added = record.factors->add(tile); !added)
    return session_error(Kind::disconnected, "the server's factors: " + added.error().message);
  return {};
}

}  // namespace

Answer<void> take(const v1::JobEvent& event, JobParts parts, JobRecord& record) {
  switch (event.event_case()) {
    case v1::JobEvent::kPlanned:
      return take_planned(event.planned(), parts, record);
    case v1::JobEvent::kTile:
      return parts == JobParts::plan ? Answer<void>() : take_tile(event.tile(), record);
    case v1::JobEvent::kFinished:
    case v1::JobEvent::kFailed:
    case v1::JobEvent::kCancelled:
      record.last = event;
      return {};
    case v1::JobEvent::kPrepared:
      record.prepared = event.prepared().timing();
      return {};
    case v1::JobEvent::kQueued:
    case v1::JobEvent::kStarted:
    case v1::JobEvent::kPreparing:
    case v1::JobEvent::kProgress:
    case v1::JobEvent::kPreview:
    case v1::JobEvent::kPaused:
    case v1::JobEvent::kRetrying:  // from the start: the next plan makes a new film
    case v1::JobEvent::EVENT_NOT_SET:
      return {};
  }
  return {};
}

Answer<void> complete(const JobRecord& record, JobParts parts) {
  if (!record.last.has_finished()) return {};
  const bool rendered = record.last.finished().timing().rays() > 0;
  if (record.film && !rendered && !record.film->complete())
    return session_error(Kind::input, "the job has no picture: it was checked or explained only");
  // A picture with holes is no result.
  if (parts != JobParts::plan && (!record.film || !record.film->complete()))
    return session_error(Kind::disconnected,
                         "the server finished the job without all of its tiles");
  return {};
}

}  // namespace metamer::client
