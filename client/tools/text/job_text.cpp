#include "client/tools/text/job_text.h"

#include <array>
#include <cmath>
#include <cstdio>

#include "client/session/job_handle.h"
#include "client/tools/text/formatted.h"
#include "common/printable.h"
#include "common/scene/methods.h"

namespace metamer::client {
namespace {

std::string tiles(std::uint32_t done, std::uint32_t all) {
  return std::to_string(done) + '/' + std::to_string(all);
}

std::string describe_kind(const v1::JobEvent& event) {
  switch (event.event_case()) {
    case v1::JobEvent::kQueued:
      return "queued, " + std::to_string(event.queued().position()) + " ahead" +
             (event.queued().reason().empty() ? "" : ": " + printable(event.queued().reason()));
    case v1::JobEvent::kStarted:
      return "started, attempt " + std::to_string(event.started().attempt());
    case v1::JobEvent::kPlanned:
      return "planned: " + describe(event.planned().plan());
    case v1::JobEvent::kProgress:
      return "progress " + tiles(event.progress().tiles_done(), event.progress().tiles()) +
             " tiles, " +
             (event.progress().tiles_verified() > 0
                  ? tiles(event.progress().tiles_verified(), event.progress().tiles()) +
                        " verified, "
                  : std::string()) +
             std::to_string(event.progress().rays()) + " rays, " +
             clock(event.progress().seconds_left()) + " left";
    case v1::JobEvent::kTile:
      return "tile at " + std::to_string(event.tile().x()) + ',' + std::to_string(event.tile().y());
    case v1::JobEvent::kPreview:
      return "preview " + std::to_string(event.preview().width()) + 'x' +
             std::to_string(event.preview().height());
    case v1::JobEvent::kPreparing:
      return std::string("preparing: ") + word(event.preparing().stage());
    case v1::JobEvent::kPrepared:
      return "prepared: " + prepared_text(event.prepared().timing());
    case v1::JobEvent::kPaused:
      return "paused";
    case v1::JobEvent::kRetrying:
      return "retrying: " + printable(event.retrying().reason());
    case v1::JobEvent::kFinished:
      return "finished: " + describe(event.finished().timing());
    case v1::JobEvent::kFailed:
      return "failed: " + printable(event.failed().reason());
    case v1::JobEvent::kCancelled:
      return "cancelled";
    case v1::JobEvent::EVENT_NOT_SET:
      return "an event that this program does not know";
  }
  return {};
}

}  // namespace

std::string counted(std::uint64_t count, const char* one, const char* many) {
  return std::to_string(count) + ' ' + (count == 1 ? one : many);
}

std::string rate(std::uint64_t rays, double seconds) {
  return seconds > 0 ? formatted("%.1f Mrays/s", static_cast<double>(rays) / seconds * 1e-6)
                     : std::string("- Mrays/s");
}

std::string clock(double seconds) {
  // A count that is no sensible time is no time.
  if (!(seconds >= 0 && seconds < 1e6)) return "-:--";
  const long whole = std::lround(std::ceil(seconds));
  return whole < 3600 ? formatted("%ld:%02ld", whole / 60, whole % 60)
                      : formatted("%ld:%02ld:%02ld", whole / 3600, whole / 60 % 60, whole % 60);
}

std::string describe(const v1::Plan& plan) {
  std::string text = formatted("%ux%u, ", plan.width(), plan.height());
  text += counted(plan.spp(), "sample", "samples") + " per pixel, ";
  text += planned_method_text(plan) + ", ";
  if (!plan.observer_file().empty()) text += "observer " + quoted(plan.observer_file()) + ", ";
  if (plan.backend() != "cpu") text += "by the " + plan.backend() + " backend, ";
  text += counted(plan.lights(), "light", "lights") + ", ";
  text += counted(plan.materials(), "material", "materials") + ", ";
  text += counted(plan.triangles(), "triangle", "triangles") + ", ";
  text += counted(plan.threads(), "thread", "threads");
  if (plan.verify_cost() > 0)
    text += formatted("; verified, at about %.2g times the picture's work", plan.verify_cost());
  return text;
}

std::string describe(const v1::Timing& timing) {
  std::string text = formatted("%.2f s rendering (", timing.render()) +
                     rate(timing.rays(), timing.render()) +
                     formatted("), %.2f s in all", timing.total());
  // Less than that, nobody sees.
  if (timing.beyond_depth() + timing.below_cutoff() > 1e-3)
    text += formatted(
        "; of the light over clear surfaces up to %.2g %% is missing beyond the "
        "depth, %.2g %% below the cutoff",
        100 * timing.beyond_depth(), 100 * timing.below_cutoff());
  return text;
}

std::string prepared_text(const v1::Timing& timing) {
  return formatted("%.3f s reading, %.3f s hierarchy, %.3f s choosing, %.3f s tables",
                   timing.compile(), timing.acceleration(), timing.pilot(), timing.prepare());
}

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

const char* word(v1::Preparing::Stage stage) {
  switch (stage) {
    case v1::Preparing::READING:
      return "reading";
    case v1::Preparing::HIERARCHY:
      return "hierarchy";
    case v1::Preparing::PLANNING:
      return "planning";
    case v1::Preparing::TABLES:
      return "tables";
    default:
      return "unknown";
  }
}

std::string describe(const v1::JobSummary& job, const std::string& server) {
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), "%16s  %-9s  %11s  %8s  %-3s  ",
                to_text({job.job_id(), server}).c_str(), word(job.state()),
                job.tiles() > 0 ? tiles(job.tiles_done(), job.tiles()).c_str() : "-",
                clock(job.age()).c_str(), job.backend() == v1::GL ? "gl" : "cpu");
  const std::string user = job.user().empty() ? "-" : printable(job.user());
  // What a job waits for is said where it is asked for (waiting_text).
  const bool says =
      (job.state() == v1::FAILED || job.state() == v1::RUNNING) && !job.reason().empty();
  const std::string reason = says ? "  (" + printable(job.reason()) + ")" : "";
  const std::string label =
      job.series().label().empty() ? "" : ", " + printable(job.series().label());
  return text.data() + user + "  " + printable(job.name()) + label + reason;
}

std::string waiting_text(const v1::JobSummary& job) {
  if (job.state() == v1::PAUSED) return "waits: it is paused, until it is resumed";
  if (job.state() != v1::QUEUED) return {};
  std::string text =
      "waits: " + (job.reason().empty() ? "its turn is next" : printable(job.reason()));
  if (job.priority() != 0) text += "; its priority is " + std::to_string(job.priority());
  return text;
}

std::string describe(const v1::JobEvent& event) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%6llu  %9.3f s  ",
                static_cast<unsigned long long>(event.sequence()), event.time());
  return text.data() + describe_kind(event);
}

}  // namespace metamer::client
