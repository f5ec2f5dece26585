#pragma once

#include <boost/asio.hpp>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "server/service/store/database.h"

namespace metamer::service {

namespace asio = boost::asio;

/// Why something could not be kept.
struct StoreTrouble {
  std::string message;
  bool may_pass = false;    ///< The disk is full, say: the same may be asked for again.
  bool wants_room = false;  ///< That is why: with room it would have been done.
};

/// One thread that writes what is to outlive the process, in the order in which it was posted. What
/// has gathered while it wrote goes into one transaction, so that a disk's one answer serves all
/// (group commit). All but the constructor's thread is the loop's.
class Journal {
 public:
  /// Runs on the journal's thread, inside a transaction. May run several times, all but the last in
  /// one that was undone: whatever it does beside the database has to be the same then. Throws
  /// DatabaseError, std::system_error.
  using Work = std::function<void(Database&)>;
  /// Runs on the loop, once the work is on the disk or can't be.
  using Done = std::function<void(const std::optional<StoreTrouble>&)>;

  Journal(asio::any_io_executor loop, std::unique_ptr<Database> database);
  /// Carries out what was posted. Its Done functions may not be called any more.
  ~Journal();
  Journal(const Journal&) = delete;
  Journal& operator=(const Journal&) = delete;

  void post(Work work, Done done = {});
  /// Waits until all that was posted so far has been carried out. The trouble of `work`, if any.
  asio::awaitable<std::optional<StoreTrouble>> carry_out(Work work);

  /// What is asked on the loop for room on the disk before something is refused for want of it, and
  /// again until it has made none: false.
  void make_room_by(std::function<bool()> make_room) { make_room_ = std::move(make_room); }

  /// Transactions so far; for the loop's thread.
  std::uint64_t commits() const { return commits_; }

 private:
  struct Entry {
    Work work;
    Done done;
    std::optional<StoreTrouble> trouble;
  };
  void run();
  void write(std::vector<Entry>& batch);
  void write_one(Entry& entry);
  std::optional<StoreTrouble> try_one(const Entry& entry);
  bool ask_for_room();
  void finish(std::vector<Entry> batch);

  asio::any_io_executor loop_;
  std::unique_ptr<Database> database_;
  std::optional<StoreTrouble> broken_;  // of the thread: nothing can be written any more
  std::uint64_t commits_ = 0;
  std::function<bool()> make_room_;
  std::shared_ptr<int> alive_ = std::make_shared<int>(0);  // watched by what was posted to the loop

  std::mutex mutex_;
  std::condition_variable wake_;
  std::vector<Entry> waiting_;
  bool stopping_ = false;
  std::optional<bool> room_made_;  // the answer, once there is one
  std::thread thread_;
};

}  // namespace metamer::service
