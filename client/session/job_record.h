#pragma once

#include <optional>

#include "client/relight/factors.h"
#include "client/session/error.h"
#include "client/session/film.h"
#include "client/session/job_handle.h"
#include "metamer/v1/jobs.pb.h"
#include "metamer/v1/plan.pb.h"

namespace metamer::client {

/// What of a job is kept.
enum class JobParts { plan, picture, picture_and_factors };

/// What has come of a job, event by event.
struct JobRecord {
  JobHandle job;
  v1::JobEvent last;  ///< finished, failed or cancelled; none before the end.
  std::optional<v1::Plan> plan;
  std::optional<v1::Timing> prepared;     ///< What it took to the first tile, where that was said.
  std::optional<Film> film;               ///< Where the picture is kept and was planned.
  std::optional<FactorsBuilder> factors;  ///< Where they are kept and the job has them.
  bool factors_lost = false;              ///< There are more than the server keeps.
};

/// Takes the job's next event into its record; a new plan begins a new picture. Errors, all of them
/// the server's fault: a tile before its plan or beside its picture, factors that fit no scene.
Answer<void> take(const v1::JobEvent& event, JobParts parts, JobRecord& record);

/// Whether a record that has its last event has all that it should. Errors: a finished job that has
/// no picture, as it was checked only (input), or not all of it (disconnected).
Answer<void> complete(const JobRecord& record, JobParts parts);

}  // namespace metamer::client
