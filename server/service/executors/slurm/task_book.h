#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "server/service/executors/slurm/squeue.h"

namespace metamer::service {

/// A task by what is ours of it: the name that its array was given, which never comes twice, and
/// its place there. Slurm's own numbers come again after a crash, and mean nothing here.
struct TaskKey {
  std::string name;
  std::uint32_t index = 0;
  auto operator<=>(const TaskKey&) const = default;
};

/// The tasks that should run, held against what squeue lists: values in, verdicts out. Times are
/// seconds of a clock that does not go back.
class TaskBook {
 public:
  /// A task of which nothing has been seen for so long, or that ended so long ago without a result
  /// (files may be seen late), is lost.
  explicit TaskBook(double patience) : patience_(patience) {}

  /// sbatch has said that it has these: `count` of them from index 0 on.
  void add(const std::string& name, std::uint32_t count, double now);
  /// Nobody waits for it any more.
  void erase(const TaskKey& key) { tasks_.erase(key); }
  bool has(const TaskKey& key) const { return tasks_.contains(key); }
  std::size_t size() const { return tasks_.size(); }

  struct Loss {
    TaskKey key;
    std::string reason;  ///< "ended as NODE_FAIL on n2"
    /// It may be the job's doing. Not of one that Slurm forgot or took back.
    bool counts = false;
  };
  /// Takes a listing; gives the tasks that are lost by now, and forgets them.
  std::vector<Loss> reconcile(const std::vector<ListedTask>& listing, double now);

  /// What the last listing said.
  struct Seen {
    ListedTask::State state = ListedTask::State::waiting;
    std::string node;
  };
  Seen seen(const TaskKey& key) const;

  /// Names in a listing that hold tasks which have not ended, and none of the book's: what an
  /// earlier server, or a cancellation that Slurm did not hear of, has left.
  std::vector<std::string> strangers(const std::vector<ListedTask>& listing) const;

 private:
  struct Task {
    double alive = 0;    // when it was last known to wait or run
    bool ended = false;  // since then
    std::string word;    // Slurm's last of it
    Seen seen;
  };
  void note(const TaskKey& key, const ListedTask& listed, double now,
            std::map<TaskKey, bool>& living);

  double patience_;
  std::map<TaskKey, Task> tasks_;
};

}  // namespace metamer::service
