#include "client/cli/job_text.h"

#include <array>
#include <cstdio>

#include "client/cli/progress.h"

namespace metamer::cli {
namespace {

std::string tiles(std::uint32_t done, std::uint32_t all) {
  return std::to_string(done) + '/' + std::to_string(all);
}

std::string describe_kind(const v1::JobEvent& event) {
  switch (event.event_case()) {
    case v1::JobEvent::kQueued:
      return "queued, " + std::to_string(event.queued().position()) + " ahead";
    case v1::JobEvent::kStarted:
      return "started, attempt " + std::to_string(event.started().attempt());
    case v1::JobEvent::kPlanned:
      return "planned: " + describe(event.planned().plan());
    case v1::JobEvent::kProgress:
      return "progress " + tiles(event.progress().tiles_done(), event.progress().tiles()) +
             " tiles, " + std::to_string(event.progress().rays()) + " rays, " +
             clock(event.progress().seconds_left()) + " left";
    case v1::JobEvent::kTile:
      return "tile at " + std::to_string(event.tile().x()) + ',' + std::to_string(event.tile().y());
    case v1::JobEvent::kPreview:
      return "preview " + std::to_string(event.preview().width()) + 'x' +
             std::to_string(event.preview().height());
    case v1::JobEvent::kPaused:
      return "paused";
    case v1::JobEvent::kRetrying:
      return "retrying: " + event.retrying().reason();
    case v1::JobEvent::kFinished:
      return "finished: " + describe(event.finished().timing());
    case v1::JobEvent::kFailed:
      return "failed: " + event.failed().reason();
    case v1::JobEvent::kCancelled:
      return "cancelled";
    case v1::JobEvent::EVENT_NOT_SET:
      return "an event that this program does not know";
  }
  return {};
}

}  // namespace

const char* word(v1::JobState state) {
  switch (state) {
    case v1::QUEUED:
      return "queued";
    case v1::RUNNING:
      return "running";
    case v1::PAUSED:
      return "paused";
    case v1::FINISHED:
      return "finished";
    case v1::FAILED:
      return "failed";
    case v1::CANCELLED:
      return "cancelled";
    default:
      return "unknown";
  }
}

std::string describe(const v1::JobSummary& job) {
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), "%16llu  %-9s  %11s  %8s  ",
                static_cast<unsigned long long>(job.job_id()), word(job.state()),
                job.tiles() > 0 ? tiles(job.tiles_done(), job.tiles()).c_str() : "-",
                clock(job.age()).c_str());
  return text.data() + job.name() + (job.reason().empty() ? "" : "  (" + job.reason() + ")");
}

std::string describe(const v1::JobEvent& event) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%6llu  %9.3f s  ",
                static_cast<unsigned long long>(event.sequence()), event.time());
  return text.data() + describe_kind(event);
}

}  // namespace metamer::cli
