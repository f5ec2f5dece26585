#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/problem.h"
#include "metamer/v1/jobs.pb.h"

namespace metamer::client {

/// A series as a server's list of jobs shows it.
struct ListedSeries {
  v1::Series series;  ///< As one of its jobs has it.
  std::string user;
  v1::Backend backend = v1::CPU;
  double age = 0;  ///< Seconds since the first of those that are listed was submitted.
  std::uint32_t queued = 0, running = 0, paused = 0, finished = 0, failed = 0, cancelled = 0;
  /// Jobs before the newest that are not listed: they were refused, or ended so long ago that the
  /// server has forgotten them.
  std::uint32_t gone = 0;
  std::uint32_t to_come = 0;        ///< After it: not submitted, or not yet.
  std::vector<std::string> places;  ///< Where those that run are, as far as that is said.

  std::uint32_t live() const { return queued + running + paused; }
};

/// Those of which a job is listed, in the order of their first ones.
std::vector<ListedSeries> listed_series(const v1::JobList& list);

/// A line of a list, beside describe(job).
std::string describe(const ListedSeries& series);

/// Whether a person's word names a series: "series:3f9c2a1b" or "series:booth.txtpb, turntable".
bool names_series(const std::string& word);
/// The one that it names, by at least 6 of the digits of its id, or by its name; of several that
/// which is live alone. Errors: there is none; there are several.
Result<ListedSeries> find_series(const std::vector<ListedSeries>& listed, const std::string& word);

}  // namespace metamer::client
