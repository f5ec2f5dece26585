#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "common/problem.h"
#include "metamer/v1/session.pb.h"
#include "server/service/jobs/job_counts.h"
#include "server/service/net/traffic.h"

namespace metamer::service {

/// All that is counted, and what there is at the moment.
struct Counts {
  JobCounts jobs;
  Traffic traffic;
  double uptime = 0;  ///< Seconds.
  std::uint64_t sessions = 0, views = 0;
  std::uint64_t jobs_queued = 0, jobs_running = 0;
  std::uint64_t store_bytes = 0, state_bytes = 0;
  struct Worker {
    std::string name;  ///< Of its lane: "cpu".
    std::uint64_t starts = 0, losses = 0;
  };
  std::vector<Worker> workers;
};

/// A value, and the labels that tell it from others of its name: `backend="cpu"`; may be empty.
using Sample = std::pair<std::string, double>;

/// A row of the table: a metric as Prometheus knows it.
struct MetricRow {
  const char* name;
  enum class Kind { counter, gauge } kind;
  const char* meaning;  ///< A sentence without a full stop.
  std::vector<Sample> (*samples)(const Counts&);
};
const std::vector<MetricRow>& all_metrics();

/// Prometheus's text format 0.0.4: HELP, TYPE and samples of each row.
std::string prometheus_text(const Counts& counts);

/// The same for clients.
void add_metrics(const Counts& counts, v1::Info& info);

/// Puts a text in the place of a file, whole: whoever reads it gets the one before or this one.
/// Errors: the system's.
Result<void> replace_file(const std::filesystem::path& file, const std::string& text);

}  // namespace metamer::service
