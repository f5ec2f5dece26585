#include "server/service/executors/slurm/slurm_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "server/service/limits.h"
#include "server/service/ops/log.h"

namespace metamer::service {
namespace {

/// Of a result's pixels: it is read and hashed while others wait for the disk.
constexpr double most_range_bytes = 16u << 20;
constexpr std::uint32_t most_tiles_with_factors = 16;
/// Seconds: that it renders at all is what the first task is for.
constexpr double least_pilot = 1e-6;
/// Where nobody has measured it.
constexpr double guessed_tile_seconds = 0.1;

}  // namespace

SlurmRun::SlurmRun(JobQueue::JobPtr job, JobQueue& queue, std::unique_ptr<AssetFolder> assets,
                   std::filesystem::path folder, const Options& options)
    : job_(std::move(job)),
      queue_(queue),
      assets_(std::move(assets)),
      folder_(std::move(folder)),
      options_(options) {}

// ---- Orders

std::size_t SlurmRun::waiting() const {
  if (over_ || draining_ || !begun_to_order_) return 0;
  return stage_ == Stage::rendering ? ranges_->waiting() : wanted_;
}

v1::BatchOrder SlurmRun::order(std::uint64_t attempt) const {
  const v1::Submit& submit = job_->submit();
  v1::BatchOrder order;
  order.set_job_id(job_->id());
  order.set_attempt(attempt);
  order.set_build(options_.build);
  order.set_assets(assets_->path());
  order.set_result(result_file(folder_, attempt));
  v1::CompileJob& compile = *order.mutable_compile();
  compile.set_scene_sha256(submit.scene_sha256());
  *compile.mutable_asset() = submit.asset();
  compile.set_keep_factors(submit.keep_factors());
  if (job_->method()) *compile.mutable_chosen() = *job_->method();
  if (plan_) *order.mutable_plan() = *plan_;
  return order;
}

std::optional<v1::BatchOrder> SlurmRun::next_order() {
  if (waiting() == 0) return std::nullopt;
  v1::BatchOrder next;
  if (stage_ == Stage::rendering) {
    const auto range = ranges_->hand_out();
    next = order(range->attempt);
    next.set_first(range->range.first);
    next.set_count(range->range.count);
  } else {
    wanted_ = false;
    next = order(++attempts_);
    if (stage_ == Stage::concluding) {
      next.set_conclude(true);
      if (job_->verifies()) next.set_picture(folder_ / "picture");
    } else {
      const v1::Submit& submit = job_->submit();
      const double pilot =
          std::max(least_pilot, std::chrono::duration<double>(options_.pilot_time).count());
      next.mutable_compile()->set_explain(submit.explain());
      next.mutable_compile()->set_prepare(submit.check_only() && submit.prepare());
      // Of a job that goes on it is known what a tile takes.
      if (!submit.check_only() && job_->tiles_done() == 0) next.set_seconds(pilot);
    }
  }
  out_.push_back({next.attempt(), std::nullopt});
  return next;
}

std::string SlurmRun::picture_bytes() const {
  return std::string(reinterpret_cast<const char*>(std::as_const(job_->film()).at(0, 0)),
                     job_->film_bytes());
}

void SlurmRun::submitted(std::uint64_t attempt, TaskKey key) {
  if (const auto found = find(attempt); found != out_.end()) found->key = std::move(key);
}

std::vector<SlurmRun::Out>::iterator SlurmRun::find(std::uint64_t attempt) {
  return std::find_if(out_.begin(), out_.end(),
                      [&](const Out& one) { return one.attempt == attempt; });
}

// ---- Results

void SlurmRun::take(FoundResult result) {
  const auto found = find(result.attempt);
  if (over_ || found == out_.end()) return;  // another was first
  for (const std::string& bytes : result.message.damaged())
    if (const auto digest = digest_from_bytes(bytes)) assets_->doubt(*digest);
  const std::string& node = result.message.node();
  if (result.damage.empty() &&
      (result.message.job_id() != job_->id() || result.message.attempt() != result.attempt))
    result.damage = "a result of another task";
  if (!result.damage.empty()) return lose(result.attempt, result.damage, true);
  if (!result.message.lost().empty())
    return lose(result.attempt, result.message.lost() + " (on " + node + ")", true);
  if (stage_ == Stage::rendering && !result.message.has_failed())
    return take_range(std::move(result));

  out_.erase(found);
  if (result.message.has_failed()) {
    v1::Failed failed = result.message.failed();
    if (failed.kind() == v1::Failed::UNSPECIFIED) failed.set_kind(v1::Failed::SERVER);
    job_->fail(std::move(failed));
    over_ = true;
  } else if (stage_ == Stage::planning) {
    take_plan(std::move(result));
  } else {
    add_record(result.message, 0);
    conclude(result.message.done());
  }
}

void SlurmRun::take_plan(FoundResult result) {
  if (!accept_plan(result)) return;
  if (job_->submit().check_only()) {
    if (result.message.has_prepared()) {
      job_->add_prepared(result.message.prepared());
      *done_.mutable_timing() = result.message.prepared();
    }
    job_->finish(std::move(done_));
    over_ = true;
    return;
  }
  if (!job_->make_film()) return fail(v1::Failed::SERVER, "no memory for the picture");
  if (result.message.has_prepared()) {
    job_->add_prepared(result.message.prepared());
    *done_.mutable_timing() = result.message.prepared();
  }
  first_seconds_ = result.message.seconds();
  const double seconds = seconds_per_tile(result);
  put_first_tiles(result);
  if (job_->tiles_done() < job_->tiles().size()) return cut_ranges(seconds);
  if (result.range.tiles.size() == job_->tiles().size()) return conclude(result.message.done());
  picture_is_whole();
}

/// False: it is none, and the task is lost.
bool SlurmRun::accept_plan(const FoundResult& result) {
  Result<void> accepted;
  if (!result.message.has_plan()) accepted = problem("there is none");
  if (accepted && !result.message.scene_factors().empty())
    accepted = job_->add_factors(std::nullopt, result.message.scene_factors());
  if (accepted) accepted = job_->plan(result.message.plan());
  if (!accepted) {
    wanted_ = true;
    if (++failures_ >= max_losses)
      fail(v1::Failed::WORKER, "a plan that can't be: " + accepted.error().message);
    return false;
  }
  plan_ = result.message.plan();
  failures_ = 0;
  return true;
}

/// What the first task has drawn, up to a tile that is not as it should be.
void SlurmRun::put_first_tiles(FoundResult& result) {
  std::uint64_t rays = 0;
  std::uint32_t index = result.message.first();
  for (RangeResult::Tile& tile : result.range.tiles) {
    if (!fits(*job_, index, tile) || job_->tile_done(index)) break;
    rays += tile.rays;
    put_tile(*job_, index++, std::move(tile));
  }
  add_record(result.message, index - result.message.first());
  count(index - result.message.first(), rays);
}

/// What a task whose result counts has come to.
void SlurmRun::add_record(const v1::BatchResult& message, std::size_t tiles) {
  v1::RunRecord record = message.record();
  if (record.machine_size() == 0) record.add_machine()->set_cpu(message.cpu());
  record.mutable_machine(0)->set_name(message.node());
  job_->add_run(std::move(record), static_cast<std::uint32_t>(tiles));
}

double SlurmRun::seconds_per_tile(const FoundResult& first) const {
  const auto tiles = static_cast<double>(first.range.tiles.size());
  const double measured = tiles > 0 ? first.message.seconds() / tiles : 0;
  if (measured > 0) return measured;
  if (job_->tiles_done() > 0 && job_->worker_seconds() > 0)
    return job_->worker_seconds() / job_->tiles_done();
  for (const v1::Prediction& one : plan_->prediction())
    if (one.chosen() && one.render() > 0) return one.render() / job_->tiles().size();
  return guessed_tile_seconds;
}

/// So that a task takes as long as is worth starting it.
void SlurmRun::cut_ranges(double seconds_per_tile) {
  const double tile_bytes =
      static_cast<double>(plan_->tile_size()) * plan_->tile_size() * Film::pixel_bytes;
  double most = std::min(
      std::ceil(std::chrono::duration<double>(options_.task_time).count() / seconds_per_tile),
      most_range_bytes / tile_bytes);
  if (job_->submit().keep_factors()) most = std::min<double>(most, most_tiles_with_factors);
  ranges_.emplace(*job_, attempts_, static_cast<std::uint32_t>(std::max(1.0, most)));
  stage_ = Stage::rendering;
}

void SlurmRun::take_range(FoundResult result) {
  const auto tiles = result.range.tiles.size();
  std::uint64_t rays = 0;
  for (const RangeResult::Tile& tile : result.range.tiles) rays += tile.rays;
  const std::uint64_t attempt = result.attempt;
  switch (ranges_->take(std::move(result.range))) {
    case TileRanges::Verdict::damaged:
      if (ranges_->hopeless()) fail(v1::Failed::WORKER, "other tiles came than were asked for");
      break;
    case TileRanges::Verdict::counts:
      add_record(result.message, tiles);
      count(tiles, rays);
      break;
    case TileRanges::Verdict::late:
      break;
  }
  if (const auto found = find(attempt); found != out_.end()) out_.erase(found);
  if (over_) return;
  if (ranges_->complete()) picture_is_whole();
}

void SlurmRun::lose(std::uint64_t attempt, const std::string& reason, bool counts) {
  const auto found = find(attempt);
  if (over_ || found == out_.end()) return;
  out_.erase(found);
  log_line(spdlog::level::warn,
           {.user = std::string(job_->user()), .job = job_->id(), .reason = reason},
           "a task is lost");
  bool hopeless = false;
  if (stage_ == Stage::rendering) {
    counts ? ranges_->lose(attempt) : ranges_->withdraw(attempt);
    hopeless = ranges_->hopeless();
  } else {
    wanted_ = true;
    hopeless = counts && ++failures_ >= max_losses;
  }
  if (hopeless)
    return fail(v1::Failed::WORKER,
                fmt::format("a task was lost {} times: {}", max_losses, reason));
}

bool SlurmRun::has_out(const TaskKey& key) const {
  return std::any_of(out_.begin(), out_.end(), [&](const Out& one) { return one.key == key; });
}

void SlurmRun::lose(const TaskBook::Loss& loss) {
  const auto found =
      std::find_if(out_.begin(), out_.end(), [&](const Out& one) { return one.key == loss.key; });
  if (found != out_.end()) lose(found->attempt, loss.reason, loss.counts);
}

// ---- Ends

void SlurmRun::picture_is_whole() {
  ranges_.reset();
  if (!plan_->has_auto_() && !job_->verifies()) return conclude(std::move(done_));
  stage_ = Stage::concluding;
  wanted_ = true;
  failures_ = 0;
}

/// `done` is of the task that saw the picture whole.
void SlurmRun::conclude(v1::JobDone done) {
  // The clock of `render` begins with the plan, and what the first task rendered was before.
  done.set_setup(-first_seconds_);
  if (done_.has_timing()) {
    const double verify = done.timing().verify();
    *done.mutable_timing() = done_.timing();
    done.mutable_timing()->set_verify(verify);
  }
  // A task knows its own time, not that of all.
  const std::chrono::duration<double> elapsed = Clock::now() - begun_;
  if (plan_->auto_().has_deadline())
    done.mutable_accuracy()->set_kept(elapsed.count() <= plan_->auto_().deadline());
  over_ = true;
  if (done.has_better() && job_->restart("the promise was broken", done.better()))
    return queue_.put_back(job_);
  job_->finish(std::move(done));
}

void SlurmRun::fail(v1::Failed::Kind kind, const std::string& reason) {
  job_->fail(kind, reason);
  over_ = true;
}

void SlurmRun::settle() {
  if (!draining_ || !out_.empty() || over_) return;
  over_ = true;
  if (job_->yield("others have their turn", queue_.queued())) queue_.put_back(job_);
}

void SlurmRun::count(std::uint64_t tiles, std::uint64_t rays) {
  queue_.counts().tiles[job_->submit().backend()] += tiles;
  queue_.counts().rays[job_->submit().backend()] += rays;
}

}  // namespace metamer::service
