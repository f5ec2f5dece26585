#include "server/service/ops/metrics.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace metamer::service {

namespace {

using Kind = MetricRow::Kind;

std::vector<Sample> one(double value) { return {{"", value}}; }

double number(std::uint64_t value) { return static_cast<double>(value); }

template <class Number>
std::vector<Sample> by_backend(const std::map<v1::Backend, Number>& counted) {
  const auto of = [&](v1::Backend backend) {
    const auto found = counted.find(backend);
    return found == counted.end() ? 0.0 : static_cast<double>(found->second);
  };
  return {{"backend=\"cpu\"", of(v1::CPU)}, {"backend=\"gl\"", of(v1::GL)}};
}

std::vector<Sample> by_worker(const Counts& counts, std::uint64_t Counts::Worker::*member) {
  std::vector<Sample> samples;
  for (const Counts::Worker& worker : counts.workers)
    samples.emplace_back(fmt::format("worker=\"{}\"", worker.name), number(worker.*member));
  return samples;
}

/// Each code that there is, also those that were not needed yet.
std::vector<Sample> refusals(const Counts& counts) {
  std::vector<Sample> samples;
  for (int code = v1::Error::Code_MIN; code <= v1::Error::Code_MAX; ++code) {
    if (code == v1::Error::UNSPECIFIED || !v1::Error::Code_IsValid(code)) continue;
    const auto found = counts.traffic.refusals.find(static_cast<v1::Error::Code>(code));
    const std::uint64_t times = found == counts.traffic.refusals.end() ? 0 : found->second;
    samples.emplace_back(
        fmt::format("code=\"{}\"", v1::Error::Code_Name(static_cast<v1::Error::Code>(code))),
        number(times));
  }
  return samples;
}

double failed_logins(const Counts& counts) {
  const auto found = counts.traffic.refusals.find(v1::Error::UNAUTHENTICATED);
  return found == counts.traffic.refusals.end() ? 0 : number(found->second);
}

}  // namespace

const std::vector<MetricRow>& all_metrics() {
  static const std::vector<MetricRow> rows = {
      {"metamer_uptime_seconds", Kind::gauge, "time since the daemon's start",
       [](const Counts& all) { return one(all.uptime); }},
      {"metamer_jobs_submitted_total", Kind::counter, "jobs that were taken",
       [](const Counts& all) { return one(number(all.jobs.submitted)); }},
      {"metamer_jobs_ended_total", Kind::counter, "jobs by how they ended",
       [](const Counts& all) {
         return std::vector<Sample>{{"end=\"finished\"", number(all.jobs.finished)},
                                    {"end=\"failed\"", number(all.jobs.failed)},
                                    {"end=\"cancelled\"", number(all.jobs.cancelled)}};
       }},
      {"metamer_jobs_queued", Kind::gauge, "jobs that wait",
       [](const Counts& all) { return one(number(all.jobs_queued)); }},
      {"metamer_jobs_running", Kind::gauge, "jobs that workers have",
       [](const Counts& all) { return one(number(all.jobs_running)); }},
      {"metamer_tiles_total", Kind::counter, "tiles that were drawn, by backend",
       [](const Counts& all) { return by_backend(all.jobs.tiles); }},
      {"metamer_rays_total", Kind::counter, "rays that were traced for them, by backend",
       [](const Counts& all) { return by_backend(all.jobs.rays); }},
      {"metamer_worker_seconds_total", Kind::counter, "time that workers spent on jobs, by backend",
       [](const Counts& all) { return by_backend(all.jobs.worker_seconds); }},
      {"metamer_worker_losses_total", Kind::counter,
       "workers that died or were ended for what they did",
       [](const Counts& all) { return by_worker(all, &Counts::Worker::losses); }},
      {"metamer_worker_starts_total", Kind::counter, "workers that were started",
       [](const Counts& all) { return by_worker(all, &Counts::Worker::starts); }},
      {"metamer_sessions", Kind::gauge, "connections that are open",
       [](const Counts& all) { return one(number(all.sessions)); }},
      {"metamer_sessions_total", Kind::counter, "connections that said Hello",
       [](const Counts& all) { return one(number(all.traffic.greeted)); }},
      {"metamer_views", Kind::gauge, "views that are open",
       [](const Counts& all) { return one(number(all.views)); }},
      {"metamer_received_bytes_total", Kind::counter, "bytes of messages from clients",
       [](const Counts& all) { return one(number(all.traffic.received)); }},
      {"metamer_sent_bytes_total", Kind::counter, "bytes of messages to clients",
       [](const Counts& all) { return one(number(all.traffic.sent)); }},
      {"metamer_refusals_total", Kind::counter, "requests that were not carried out, by code",
       refusals},
      {"metamer_logins_failed_total", Kind::counter, "connections that could not say who they are",
       [](const Counts& all) { return one(failed_logins(all)); }},
      {"metamer_store_bytes", Kind::gauge, "bytes of assets that are kept",
       [](const Counts& all) { return one(number(all.store_bytes)); }},
      {"metamer_state_bytes", Kind::gauge, "bytes of pictures in the state's folder",
       [](const Counts& all) { return one(number(all.state_bytes)); }},
  };
  return rows;
}

std::string prometheus_text(const Counts& counts) {
  std::string text;
  for (const MetricRow& row : all_metrics()) {
    text += fmt::format("# HELP {0} {1}.\n# TYPE {0} {2}\n", row.name, row.meaning,
                        row.kind == Kind::counter ? "counter" : "gauge");
    for (const auto& [labels, value] : row.samples(counts))
      text += fmt::format("{}{} {}\n", row.name, labels.empty() ? "" : "{" + labels + "}", value);
  }
  return text;
}

void add_metrics(const Counts& counts, v1::Info& info) {
  for (const MetricRow& row : all_metrics()) {
    for (const auto& [labels, value] : row.samples(counts)) {
      v1::Metric& metric = *info.add_metric();
      metric.set_name(row.name);
      metric.set_label(labels);
      metric.set_value(value);
    }
  }
}

Result<void> replace_file(const std::filesystem::path& file, const std::string& text) {
  // Beside it, for a rename crosses no file systems; a second daemon with the same file has its
  // own.
  const std::string beside = file.string() + "." + std::to_string(::getpid()) + ".tmp";
  const auto fail = [&](const char* what) {
    const std::string reason = std::strerror(errno);
    ::unlink(beside.c_str());
    return problem(std::string("can't ") + what + " " + file.string() + ": " + reason);
  };
  const int fd =
      ::open(beside.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0644);
  if (fd < 0) return fail("write");
  ::fchmod(fd, 0644);
  const ssize_t written = ::write(fd, text.data(), text.size());
  if (::close(fd) != 0 || written != static_cast<ssize_t>(text.size())) return fail("write");
  if (::rename(beside.c_str(), file.c_str()) != 0) return fail("replace");
  return {};
}

}  // namespace metamer::service
