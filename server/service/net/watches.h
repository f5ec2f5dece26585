#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "metamer/v1/envelope.pb.h"
#include "server/service/jobs/job_queue.h"

namespace metamer::service {

/// The jobs that one session watches. Nothing is queued: each watch remembers the number of the
/// next event, and reads that from the job's log when there is room to send it.
class Watches {
 public:
  /// `wake` is called when next() may have something.
  explicit Watches(std::function<void()> wake) : wake_(std::move(wake)) {}

  std::size_t size() const { return watches_.size(); }
  void add(std::uint64_t request_id, const v1::Watch& request, const JobQueue::JobPtr& job);
  /// Ends what was asked for under this id. False: nothing was, or it has ended.
  bool remove(std::uint64_t request_id);
  void clear() { watches_.clear(); }
  /// The server ends: each watch gets what has happened until now, then Error CLOSING with
  /// `message` and its job's number.
  void close(const std::string& message);

  /// The next event of one of the watches, in turns; nothing when none has one. A watch ends with
  /// its job's last event, or with Error LIMIT where its next tile is no longer kept.
  std::optional<v1::Envelope> next();

 private:
  struct Watch {
    std::uint64_t request_id = 0;
    std::unique_ptr<Job::Watcher> watcher;
    std::uint64_t from = 1;
    EventLog::Filter filter;
    bool factors = false;
    std::uint64_t last = 0;  ///< The event after which the server's closing is told.
  };

  std::function<void()> wake_;
  std::vector<Watch> watches_;
  std::size_t turn_ = 0;
  std::optional<std::string> closing_;  // why
};

}  // namespace metamer::service
