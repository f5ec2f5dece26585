#include "server/service/jobs/job_state.h"

namespace metamer::service {

namespace {

using State = std::optional<v1::JobState>;

State from_queued(Step step) {
  switch (step) {
    case Step::start:
      return v1::RUNNING;
    case Step::pause:
      return v1::PAUSED;
    case Step::fail:
      return v1::FAILED;
    case Step::cancel:
      return v1::CANCELLED;
    case Step::retry:
    case Step::yield:
    case Step::resume:
    case Step::finish:
      return std::nullopt;
  }
  return std::nullopt;
}

State from_running(Step step) {
  switch (step) {
    case Step::retry:
    case Step::yield:
      return v1::QUEUED;
    case Step::pause:
      return v1::PAUSED;
    case Step::finish:
      return v1::FINISHED;
    case Step::fail:
      return v1::FAILED;
    case Step::cancel:
      return v1::CANCELLED;
    case Step::start:
    case Step::resume:
      return std::nullopt;
  }
  return std::nullopt;
}

State from_paused(Step step) {
  switch (step) {
    case Step::resume:
      return v1::QUEUED;
    case Step::cancel:
      return v1::CANCELLED;
    case Step::start:
    case Step::retry:
    case Step::yield:
    case Step::pause:
    case Step::finish:
    case Step::fail:
      return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace

std::optional<v1::JobState> next_state(v1::JobState from, Step step) {
  if (from == v1::QUEUED) return from_queued(step);
  if (from == v1::RUNNING) return from_running(step);
  if (from == v1::PAUSED) return from_paused(step);
  return std::nullopt;
}

bool is_end(v1::JobState state) {
  return state == v1::FINISHED || state == v1::FAILED || state == v1::CANCELLED;
}

const char* word(v1::JobState state) {
  if (state == v1::QUEUED) return "queued";
  if (state == v1::RUNNING) return "running";
  if (state == v1::PAUSED) return "paused";
  if (state == v1::FINISHED) return "finished";
  if (state == v1::FAILED) return "failed";
  if (state == v1::CANCELLED) return "cancelled";
  return "unknown";
}

}  // namespace metamer::service
