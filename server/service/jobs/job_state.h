#pragma once

#include <optional>

#include "metamer/v1/jobs.pb.h"

namespace metamer::service {

/// What can happen to a job.
enum class Step {
  start,  ///< A worker takes it.
  retry,  ///< Its worker was lost.
  yield,  ///< It has had its turn, and another waits.
  pause,
  resume,
  finish,
  fail,
  cancel,
};

/// The state after `step`; nothing where `from` does not allow it. The whole table:
///
///              start    retry   yield   pause   resume  finish    fail    cancel
///     queued   running  -       -       paused  -       -         failed  cancelled
///     running  -        queued  queued  paused  -       finished  failed  cancelled
///     paused   -        -       -       -       queued  -         -       cancelled
///     ended    -        -       -       -       -       -         -       -
std::optional<v1::JobState> next_state(v1::JobState from, Step step);

/// Finished, failed or cancelled: nothing follows.
bool is_end(v1::JobState state);

/// The word for it: "queued".
const char* word(v1::JobState state);

}  // namespace metamer::service
