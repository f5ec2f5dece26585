#pragma once

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/awaitable.hpp>
#include <boost/asio/steady_timer.hpp>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "client/session/job_record.h"
#include "client/session/session.h"
#include "client/session/submission.h"
#include "common/problem.h"

/// Many jobs that are one to their user: the frames of a turntable, the rows of a sweep.
namespace metamer::client {

/// What the jobs of a series have in common.
struct SeriesJobs {
  std::string id;    ///< series_id().
  std::string name;  ///< For people: "booth.txtpb, turntable".
  std::uint32_t count = 0;
  JobParts parts = JobParts::picture;
};

/// 16 random bytes.
std::string series_id();
/// Its bytes in hex.
std::string series_digits(const std::string& id);
/// By which people name one: "series:3f9c2a1b", its first bytes in hex.
std::string series_handle(const std::string& id);

/// How far a series is.
struct SeriesCounts {
  std::uint32_t count = 0;
  std::uint32_t done = 0, failed = 0, cancelled = 0;
  std::uint32_t submitted = 0;  ///< And not ended.
  double share = 0;             ///< Of all its work, 0 to 1, if its jobs are alike.
};

/// A job of the series that came to an end: its record, or why there is none.
using SeriesEnd = tl::expected<JobRecord, Problem>;

/// What a run asks and tells, in the thread of the session. All of them are set.
struct SeriesCalls {
  /// The job of this index, without its series, and its label; asked once, when its turn comes.
  /// Error: there is none, and it counts as failed.
  std::function<Result<Submission>(std::uint32_t index)> make;
  std::function<std::string(std::uint32_t index)> label;
  /// Once for each, in whatever order they end. A job that finished is done by its record; any
  /// other has failed.
  std::function<void(std::uint32_t index, SeriesEnd)> ended;
  std::function<void(const SeriesCounts&)> progress;
};

/// Keeps a few jobs of a series submitted, in their order, and follows them, by one session. The
/// server retries what can be retried; a job that it gives up counts as failed, and the others go
/// on. While one of them is paused no further one is submitted.
class SeriesRun {
 public:
  /// All outlive it.
  SeriesRun(Session& session, const SeriesJobs& jobs, const SeriesCalls& calls)
      : session_(session), jobs_(jobs), calls_(calls), counts_{.count = jobs.count} {}

  /// Until all have ended. Errors: the session was lost, whose jobs go on.
  boost::asio::awaitable<Answer<SeriesCounts>> run();

  /// Asks for the end of what was submitted, and submits no more; in the session's thread. So does
  /// a job that somebody else has cancelled.
  void cancel();
  bool cancelled() const { return cancelled_; }

 private:
  enum class Next { go_on, wait };
  struct Submitted {
    std::uint64_t job_id = 0;
    bool paused = false;
    double share = 0;  ///< Of its tiles.
  };

  std::size_t most_submitted() const;
  bool may_submit() const;
  boost::asio::awaitable<Next> submit_next();
  boost::asio::awaitable<void> follow(std::uint32_t index, std::uint64_t job_id);
  boost::asio::awaitable<void> wait(std::chrono::steady_clock::duration most);
  void shown(std::uint32_t index, const v1::JobEvent& event);
  void end(std::uint32_t index, SeriesEnd end);
  void tell();

  Session& session_;
  const SeriesJobs& jobs_;
  const SeriesCalls& calls_;
  SeriesCounts counts_;
  std::uint32_t next_ = 0;
  std::optional<Submission> due_;  ///< Of next_, which the server had no room for.
  unsigned refusals_ = 0;          ///< For want of room, with none of ours submitted, in a row.
  std::map<std::uint32_t, Submitted> submitted_;
  std::optional<boost::asio::steady_timer> news_;
  std::optional<SessionError> lost_;
  bool cancelled_ = false;
};

}  // namespace metamer::client
