#include "server/service/executors/slurm/task_book.h"

#include <set>
#include <string_view>

namespace metamer::service {
namespace {

/// Ends that are Slurm's own doing: they say nothing against the job.
bool is_slurms_doing(std::string_view word) {
  return word == "PREEMPTED" || word == "BOOT_FAIL" || word == "REVOKED";
}

}  // namespace

void TaskBook::add(const std::string& name, std::uint32_t count, double now) {
  for (std::uint32_t i = 0; i < count; ++i) {
    Task task;
    task.alive = now;
    tasks_[{name, i}] = task;
  }
}

/// Of several entries for one task, of which some are of attempts that Slurm made anew by itself,
/// one that lives counts.
void TaskBook::note(const TaskKey& key, const ListedTask& listed, double now,
                    std::map<TaskKey, bool>& living) {
  const auto found = tasks_.find(key);
  if (found == tasks_.end() || living[key]) return;
  Task& task = found->second;
  task.word = listed.word;
  task.seen = {listed.state, listed.node};
  task.ended = listed.state == ListedTask::State::ended;
  if (task.ended) return;
  task.alive = now;
  living[key] = true;
}

std::vector<TaskBook::Loss> TaskBook::reconcile(const std::vector<ListedTask>& listing,
                                                double now) {
  // Those that are listed by themselves, then those of which Slurm only says that they wait.
  std::map<TaskKey, bool> living;
  for (const ListedTask& listed : listing)
    if (listed.index) note({listed.name, *listed.index}, listed, now, living);
  for (const ListedTask& listed : listing) {
    if (listed.index) continue;
    for (auto task = tasks_.lower_bound({listed.name, 0});
         task != tasks_.end() && task->first.name == listed.name; ++task)
      if (!living.contains(task->first)) note(task->first, listed, now, living);
  }

  std::vector<Loss> losses;
  for (auto task = tasks_.begin(); task != tasks_.end();) {
    const auto& [key, known] = *task;
    if (living[key] || now - known.alive < patience_) {
      ++task;
      continue;
    }
    Loss loss{.key = key, .reason = "Slurm does not know it any more", .counts = false};
    if (known.ended) {
      loss.reason = "ended as " + known.word + " without a result";
      if (!known.seen.node.empty()) loss.reason += " on " + known.seen.node;
      loss.counts = !is_slurms_doing(known.word);
    }
    losses.push_back(std::move(loss));
    task = tasks_.erase(task);
  }
  return losses;
}

TaskBook::Seen TaskBook::seen(const TaskKey& key) const {
  const auto found = tasks_.find(key);
  return found == tasks_.end() ? Seen{} : found->second.seen;
}

std::vector<std::string> TaskBook::strangers(const std::vector<ListedTask>& listing) const {
  std::set<std::string> names;
  for (const ListedTask& listed : listing) {
    if (listed.state == ListedTask::State::ended) continue;
    const auto own = tasks_.lower_bound({listed.name, 0});
    if (own == tasks_.end() || own->first.name != listed.name) names.insert(listed.name);
  }
  return {names.begin(), names.end()};
}

}  // namespace metamer::service
