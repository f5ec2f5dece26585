// What has become of the tasks: results, what Slurm lists, and what follows from both.
#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <iterator>
#include <set>

#include "server/service/executors/slurm/slurm_executor.h"

namespace metamer::service {

void SlurmExecutor::look_later() {
  const bool has_to_look =
      !runs_.empty() || !leavings_.empty() || queue_.has_work(options_.backend);
  if (ending_ || looking_ || looks_later_ || !has_to_look) return;
  looks_later_ = true;
  next_look_.expires_after(options_.look);
  next_look_.async_wait([this](boost::system::error_code cancelled) {
    looks_later_ = false;
    if (!cancelled && !ending_) look();
  });
}

/// First at what Slurm lists, then for results: one that ended has left its own by then.
void SlurmExecutor::look() {
  if (looking_) return;
  looking_ = true;
  std::vector<std::filesystem::path> folders;
  for (const RunPtr& run : runs_) folders.push_back(run->folder());
  const bool lists = Clock::now() >= next_listing_;
  const auto survey = [this, folders, lists] {
    Survey seen;
    seen.listed = lists;
    try {
      if (lists) seen.listing = commands_.list(options_.server);
      seen.results = take_results(folders);
    } catch (const std::exception& error) {
      seen.listed = true;
      seen.listing = problem(error.what());
    }
    return seen;
  };
  elsewhere(survey, [this](Survey seen) { on_survey(std::move(seen)); });
}

void SlurmExecutor::on_survey(Survey survey) {
  looking_ = false;
  if (survey.listed) next_listing_ = Clock::now() + options_.listing;
  take(std::move(survey.results));
  if (survey.listed && survey.listing) take(*survey.listing);
  if (survey.listed)
    note_trouble(unanswered_, survey.listing ? "" : survey.listing.error().message);
  charge_job();
  give_way();
  end_what_is_over();
  remove_old_folders();
  say_where();
  work();  // others may begin by now, too: what they waited for was not here
}

void SlurmExecutor::take(std::vector<FoundResult> results) {
  for (FoundResult& result : results) {
    const auto found = std::find_if(runs_.begin(), runs_.end(), [&](const RunPtr& run) {
      return run->folder() == result.folder;
    });
    if (found == runs_.end()) continue;
    for (const SlurmRun::Out& one : (*found)->out())
      if (one.attempt == result.attempt && one.key) book_.erase(*one.key);
    if (!result.damage.empty() || !result.message.lost().empty()) ++losses_;
    (*found)->take(std::move(result));
  }
}

void SlurmExecutor::take(const std::vector<ListedTask>& listing) {
  charge_job();  // those that ran up to now
  lose(book_.reconcile(listing, now()));
  // A task that has just ended may still be listed as running: one that is strange twice is.
  std::vector<std::string> strange = book_.strangers(listing), still;
  std::set_intersection(strange.begin(), strange.end(), strange_.begin(), strange_.end(),
                        std::back_inserter(still));
  strange_ = std::move(strange);
  cancel(std::move(still));
}

/// What a task has said itself says more of its end than Slurm does.
void SlurmExecutor::lose(std::vector<TaskBook::Loss> losses) {
  if (losses.empty()) return;
  losses_ += static_cast<std::uint32_t>(losses.size());
  std::vector<std::filesystem::path> logs(losses.size());
  for (std::size_t i = 0; i < losses.size(); ++i)
    for (const TaskKey& key = losses[i].key; const RunPtr& run : runs_)
      if (run->has_out(key))
        logs[i] = run->folder() / key.name / (std::to_string(key.index) + ".log");
  const auto read = [losses = std::move(losses), logs]() mutable {
    for (std::size_t i = 0; i < losses.size(); ++i)
      if (const std::string words = last_words(logs[i]); !words.empty())
        losses[i].reason += ": " + words;
    return std::move(losses);
  };
  elsewhere(read, [this](const std::vector<TaskBook::Loss>& lost) {
    for (const TaskBook::Loss& loss : lost)
      for (const RunPtr& run : runs_) run->lose(loss);
    end_what_is_over();
    work();
  });
}

void SlurmExecutor::remove_old_folders() {
  const auto old = [&](const auto& one) { return Clock::now() - one.second > options_.patience; };
  for (const auto& one : leavings_) {
    if (!old(one)) continue;
    const auto remove = [folder = one.first] {
      std::error_code ignored;
      return std::filesystem::remove_all(folder, ignored);
    };
    elsewhere(remove, [](std::uintmax_t) {});
  }
  std::erase_if(leavings_, old);
}

/// A job that has had its turn gives it up where another has to wait for one.
void SlurmExecutor::give_way() {
  if (runs_.size() < most_runs || !queue_.has_work(options_.backend)) return;
  for (const RunPtr& run : runs_) {
    if (run->draining() || !queue_.gives_way(run->job())) continue;
    run->drain();
    return;
  }
}

void SlurmExecutor::say_where() {
  for (const RunPtr& run : runs_) {
    std::set<std::string> nodes;
    std::size_t running = 0;
    for (const SlurmRun::Out& one : run->out()) {
      const auto seen = one.key ? book_.seen(*one.key) : TaskBook::Seen{};
      if (seen.state != ListedTask::State::running) continue;
      ++running;
      nodes.insert(seen.node);
    }
    std::string text = fmt::format("{} tasks on {}", running, fmt::join(nodes, ", "));
    if (running == 0) text = "no task runs yet";
    if (run->out().size() > running)
      text += fmt::format("; {} waiting for Slurm", run->out().size() - running);
    if (!trouble_.empty()) text += "; " + trouble_;
    run->job().note(text);
  }
}

void SlurmExecutor::note_trouble(std::string& where, const std::string& what) {
  if (!what.empty()) next_try_ = Clock::now() + options_.try_again;
  where = what;
  const std::string& trouble = refused_.empty() ? unanswered_ : refused_;
  if (trouble == trouble_) return;
  trouble_ = trouble;
  if (!trouble.empty())
    spdlog::warn("Slurm does not take tasks: {}", trouble);
  else
    spdlog::info("Slurm takes tasks again");
  queue_.hold(options_.backend, trouble);
}

v1::WorkerInfo SlurmExecutor::info() const {
  v1::WorkerInfo info;
  info.set_state(runs_.empty() ? "idle" : "busy");
  info.set_backend(options_.backend == v1::GL ? "gl by Slurm" : "cpu by Slurm");
  info.set_starts(submissions_);
  info.set_last_exit(trouble_);
  info.set_sandbox("as its nodes have it");
  return info;
}

}  // namespace metamer::service
