#include "server/service/executors/slurm/slurm_executor.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include "server/service/executors/slurm/task_name.h"
#include "server/service/limits.h"
#include "server/service/ops/log.h"

namespace metamer::service {
namespace {

/// Tasks of one array: Slurm takes a thousand.
constexpr std::size_t most_submitted = 256;

}  // namespace

SlurmExecutor::SlurmExecutor(const asio::any_io_executor& executor, Options options,
                             JobQueue& queue, Executor& here)
    : executor_(executor),
      options_(std::move(options)),
      queue_(queue),
      here_(here),
      commands_(options_.commands, ending_),
      book_(std::chrono::duration<double>(options_.patience).count()),
      next_look_(executor) {}

SlurmExecutor::~SlurmExecutor() {
  ending_ = true;
  thread_.join();
}

double SlurmExecutor::now() const {
  return std::chrono::duration<double>(Clock::now().time_since_epoch()).count();
}

void SlurmExecutor::start() {
  here_.start();
  if (std::exchange(started_, true)) return;
  const auto clean = [folder = options_.folder, server = options_.server] {
    remove_leavings(folder, server);
    return true;
  };
  elsewhere(clean, [](bool) {});
  look();
  work();  // what an earlier server has left in the queue
}

void SlurmExecutor::stop() {
  ending_ = true;
  next_look_.cancel();
  thread_.join();
  std::set<std::string> names;
  for (const RunPtr& run : runs_)
    for (std::string& name : names_of(*run)) names.insert(std::move(name));
  (void)commands_.cancel({names.begin(), names.end()});
  runs_.clear();
  remove_leavings(options_.folder, options_.server);
}

// ---- Jobs

void SlurmExecutor::work() {
  if (ending_) return;
  while (runs_.size() < most_runs && take_next()) continue;
  hand_out();
  look_later();
}

/// Begins with the next job that can be rendered. False: there is none.
bool SlurmExecutor::take_next() {
  const JobQueue::JobPtr job = queue_.next(options_.backend);
  if (!job) return false;
  auto obstacle = job->damage();
  if (!obstacle) {
    Admission may = queue_.admission(*job);
    if (may.verdict == Admission::Verdict::never) obstacle = std::move(may.reason);
  }
  if (!obstacle) {
    begin_run(job);
    return true;
  }
  job->fail(v1::Failed::SERVER, *obstacle);
  queue_.ended(*job);
  return true;
}

void SlurmExecutor::begin_run(JobQueue::JobPtr job) {
  job->start();
  log_line(spdlog::level::info, {.user = std::string(job->user()), .job = job->id()},
           fmt::format("job {} ({}) started", job->id(), job->submit().name()));
  auto assets = AssetFolder::make(options_.store);
  Result<void> shown;
  if (assets)
    shown = (*assets)->show({&job->assets()});
  else
    shown = tl::unexpected(assets.error());
  if (!shown) {
    job->fail(v1::Failed::SERVER, shown.error().message);
    return queue_.ended(*job);
  }
  const auto run =
      std::make_shared<SlurmRun>(job, queue_, *std::move(assets),
                                 options_.folder / new_task_name(options_.server), options_.run);
  runs_.push_back(run);
  // Its attempt is on the disk before any node hears of it.
  job->when_kept([this, weak = std::weak_ptr(run)] {
    const RunPtr kept = weak.lock();
    if (ending_ || !kept) return;
    kept->begin();
    hand_out();
  });
}

void SlurmExecutor::interrupt(const Job& job) {
  const auto found = std::find_if(runs_.begin(), runs_.end(),
                                  [&](const RunPtr& run) { return &run->job() == &job; });
  if (found == runs_.end()) return;
  (*found)->leave();
  end_what_is_over();
}

void SlurmExecutor::charge_job() {
  const auto now = Clock::now();
  const std::chrono::duration<double> spent = now - std::exchange(charged_, now);
  for (const RunPtr& run : runs_) {
    const auto running =
        std::count_if(run->out().begin(), run->out().end(), [&](const SlurmRun::Out& one) {
          return one.key && book_.seen(*one.key).state == ListedTask::State::running;
        });
    if (running > 0) queue_.spend(run->job(), spent.count() * static_cast<double>(running));
  }
}

std::vector<std::string> SlurmExecutor::names_of(const SlurmRun& run) const {
  std::set<std::string> names;
  for (const SlurmRun::Out& one : run.out())
    if (one.key) names.insert(one.key->name);
  return {names.begin(), names.end()};
}

void SlurmExecutor::cancel(std::vector<std::string> names) {
  if (names.empty()) return;
  const auto order = [this, names = std::move(names)] { return commands_.cancel(names); };
  elsewhere(order, [this](const Result<void>& cancelled) {
    // What was not heard is a stranger in the next listing.
    if (!cancelled) note_trouble(unanswered_, cancelled.error().message);
  });
}

/// Its tasks are cancelled, and what they leave all the same is not looked for.
void SlurmExecutor::end_run(const RunPtr& run) {
  cancel(names_of(*run));
  for (const SlurmRun::Out& one : run->out())
    if (one.key) book_.erase(*one.key);
  leavings_.emplace_back(run->folder(), Clock::now());
  Job& job = run->job();
  if (!job.ended()) return;
  log_line(spdlog::level::info, {.user = std::string(job.user()), .job = job.id()},
           fmt::format("job {} {}", job.id(), word(job.state())));
  // The queue counted a cancelled job as ended already.
  if (job.state() != v1::CANCELLED) queue_.ended(job);
}

void SlurmExecutor::end_what_is_over() {
  std::vector<RunPtr> over;
  for (const RunPtr& run : runs_) {
    run->settle();
    if (run->over()) over.push_back(run);
  }
  std::erase_if(runs_, [](const RunPtr& run) { return run->over(); });
  for (const RunPtr& run : over) end_run(run);
  if (!over.empty()) asio::post(executor_, [this] { work(); });
}

// ---- Tasks

/// Of the jobs with orders that nobody has, one whose user has the fewest tasks, by his share.
SlurmExecutor::RunPtr SlurmExecutor::fairest() const {
  std::map<std::string_view, double> have;
  for (const RunPtr& run : runs_)
    have[run->job().user()] += static_cast<double>(run->out().size()) / run->job().share();
  RunPtr best;
  for (const RunPtr& run : runs_) {
    if (run->waiting() == 0) continue;
    const auto place = [&](const RunPtr& one) {
      return std::tuple(have[one->job().user()], -one->job().submit().priority(), one->out().size(),
                        one->job().id());
    };
    if (!best || place(run) < place(best)) best = run;
  }
  return best;
}

void SlurmExecutor::hand_out() {
  if (ending_ || Clock::now() < next_try_) return;
  std::uint64_t out = 0;
  for (const RunPtr& run : runs_) out += run->out().size();
  std::map<RunPtr, std::vector<v1::BatchOrder>> orders;
  for (; out < options_.tasks; ++out) {
    const RunPtr run = fairest();
    if (!run) break;
    orders[run].push_back(*run->next_order());
    if (orders[run].size() == most_submitted) submit(run, std::exchange(orders[run], {}));
  }
  for (auto& [run, some] : orders)
    if (!some.empty()) submit(run, std::move(some));
}

void SlurmExecutor::submit(const RunPtr& run, std::vector<v1::BatchOrder> orders) {
  const std::string name = new_task_name(options_.server);
  const Submission submission{.name = name,
                              .count = static_cast<std::uint32_t>(orders.size()),
                              .folder = run->folder() / name,
                              .nice = max_priority - run->job().submit().priority()};
  std::vector<std::uint64_t> attempts;
  for (const v1::BatchOrder& order : orders) attempts.push_back(order.attempt());
  const std::string picture = orders[0].picture();
  const auto order = [this, submission, picture, orders = std::move(orders),
                      bytes = picture.empty() ? std::string() : run->picture_bytes()] {
    try {
      auto written = write_orders(submission.folder, orders);
      if (written && !picture.empty()) written = write_picture(picture, bytes);
      return written ? commands_.submit(submission) : written;
    } catch (const std::exception& error) {
      return Result<void>(problem(error.what()));
    }
  };
  ++submissions_;
  elsewhere(order, [this, run, name, attempts](const Result<void>& result) {
    on_submitted(run, name, attempts, result);
  });
}

void SlurmExecutor::on_submitted(const RunPtr& run, const std::string& name,
                                 const std::vector<std::uint64_t>& attempts,
                                 const Result<void>& result) {
  const bool wanted = std::find(runs_.begin(), runs_.end(), run) != runs_.end();
  if (!result) {
    // Slurm may have taken them all the same: none of that name is wanted any more.
    note_trouble(refused_, result.error().message);
    cancel({name});
    for (const std::uint64_t attempt : attempts) run->lose(attempt, result.error().message, false);
    return;
  }
  note_trouble(refused_, {});
  if (!wanted) return cancel({name});
  book_.add(name, static_cast<std::uint32_t>(attempts.size()), now());
  for (std::uint32_t i = 0; i < attempts.size(); ++i) run->submitted(attempts[i], {name, i});
}

}  // namespace metamer::service
