// The picture of a job: its tiles, and what came of the promise.
#include "common/program/build_id.h"
#include "server/film/factor_sink.h"
#include "server/render/choose.h"
#include "server/render/noise.h"
#include "server/render/verify.h"
#include "server/worker/job.h"
#include "server/worker/mapped_film.h"

namespace metamer::worker {
namespace {

/// A tile as the tracer wants it: inside the picture, its corner on multiples of 8.
bool is_sound(const v1::TileRect& tile, const v1::Plan& plan) {
  return tile.x() % 8 == 0 && tile.y() % 8 == 0 && tile.width() > 0 && tile.height() > 0 &&
         tile.x() < plan.width() && tile.width() <= plan.width() - tile.x() &&
         tile.y() < plan.height() && tile.height() <= plan.height() - tile.y();
}

}  // namespace

void Job::render(const v1::RenderTiles& message) {
  messages_.begin();
  for (const v1::TileRect& tile : message.tile())
    if (!is_sound(tile, plan_))
      return messages_.failed(v1::Failed::SERVER, "a tile outside the plan");
  const MappedFilm film(options_.film_descriptor, plan_);
  if (!film) return messages_.failed(v1::Failed::SERVER, "no shared memory for the picture");

  const Film picture{film.xyz(), plan_.width(), plan_.height()};
  auto drawn = draw(message, picture);
  v1::JobDone done;
  if (drawn && message.last() && !stopped_) drawn = conclude(picture, done);
  if (!succeeds(drawn)) return;
  *done.mutable_timing() = timing_;
  *done.mutable_record() = record();
  done.set_setup(timing_.acceleration() + timing_.prepare() - planned_setup_);
  messages_.done(std::move(done));
}

/// The picture is whole: what it is worth, beside what was promised.
Result<void> Job::conclude(const Film& film, v1::JobDone& done) {
  const double elapsed = since(begun_);
  if (settings_.verify()) {
    if (auto verified = verify(film, done); !verified || stopped_) return verified;
  } else if (plan_.has_auto_()) {
    measure_promise(done);
  }
  if (stopped_ || !plan_.has_auto_()) return {};
  v1::Accuracy& accuracy = *done.mutable_accuracy();
  const bool timed = plan_.auto_().has_deadline();
  accuracy.set_kept(timed ? elapsed <= plan_.auto_().deadline()
                          : accuracy.error().maximum() <= plan_.auto_().tolerance());
  if (!timed && !accuracy.kept() && !plan_.method().has_exact())
    done.mutable_better()->mutable_exact();
  return {};
}

/// By pixels that had no part in the choice.
void Job::measure_promise(v1::JobDone& done) {
  const RunClock::Span span(run_clock_, Phase::verify);
  const Capabilities capabilities = options_.plan_capabilities();
  if (!build([&] { return probe_->prepare(stopped_); })) return;  // stopped
  *done.mutable_accuracy() =
      measure({*scene_, *probe_, settings_, capabilities, stopped_, work_}, *method_);
}

/// By all pixels: the renderer draws the picture once more, by the reference.
Result<void> Job::verify(const Film& film, v1::JobDone& done) {
  const RunClock::Span span(run_clock_, Phase::verify);
  const auto start = Clock::now();
  Verification check(*scene_, plan_, film);
  prepared_ = false;  // it will know another method
  const auto changed = renderer_->change(check.plan(), check.method(), stopped_);
  ++work_;
  if (!changed || stopped_) return changed;
  renderer_->begin(check.picture([&](std::uint32_t tiles) {
    constexpr std::uint64_t steps = 50;  // that are told of
    if (tiles * steps / check.tiles() == (tiles - 1) * steps / check.tiles()) return;
    messages_.tiles_verified(tiles);
  }));
  if (auto drawn = draw_on(); !drawn || stopped_) return drawn;
  *done.mutable_accuracy() = check.accuracy();
  if (!build([&] { return probe_->prepare(stopped_); })) return {};  // stopped
  const Capabilities capabilities = options_.plan_capabilities();
  const PilotScene pilot{*scene_, *probe_, settings_, capabilities, stopped_, work_};
  const v1::Accuracy& accuracy = done.accuracy();
  if (const auto noise = sampling_noise(pilot, plan_, *method_,
                                        {accuracy.white(0), accuracy.white(1), accuracy.white(2)}))
    *done.mutable_accuracy()->mutable_noise() = *noise;
  timing_.set_verify(since(start));
  return {};
}

/// Draws the tiles.
Result<void> Job::draw(const v1::RenderTiles& message, const Film& film) {
  if (auto ready = prepare(); !ready || stopped_ || message.tile().empty()) return ready;
  Picture picture{.film = film,
                  .samples = sample_pattern(plan_.spp()),
                  .tiles = {},
                  .tile_done = [this](const DrawnTile& drawn) { take(drawn); },
                  .keep_factors = keep_factors_};
  for (const v1::TileRect& tile : message.tile())
    picture.tiles.push_back({tile.x(), tile.y(), tile.width(), tile.height()});
  const RunClock::Span span(run_clock_, Phase::render);
  renderer_->begin(std::move(picture));
  auto drawn = draw_on();
  rays_ += renderer_->rays();
  renderer_->report(timing_);
  return drawn;
}

/// Draws on what the renderer has begun, until others have waited for a turn's time, and so on.
Result<void> Job::draw_on() {
  for (;;) {
    const auto begun = Clock::now();
    const auto is_over = [&] { return view_turns_.waiting() && Clock::now() - begun > turn_time; };
    const auto whole = renderer_->draw({stopped_, is_over, work_});
    if (!whole) return tl::unexpected(whole.error());
    if (*whole || stopped_) break;
    const RunClock::Span others(run_clock_, Phase::others);
    view_turns_.serve();
  }
  return {};
}

/// From any thread. A picture outlives its factors: a tile without any says so.
void Job::take(const DrawnTile& drawn) {
  if (drawn.factors && !too_many_factors_)
    too_many_factors_ = !messages_.factors(&drawn.rect, drawn.factors->SerializeAsString());
  messages_.tile(drawn.rect, drawn.rays);
  ++tiles_drawn_;
}

/// What the job has come to in this process.
v1::RunRecord Job::record() {
  v1::RunRecord record;
  record.set_build(build_id());
  v1::MachineRecord& machine = *record.add_machine();
  machine = options_.machine;
  machine.set_threads(plan_.threads());
  machine.set_tiles(tiles_drawn_);
  run_clock_.report(record);
  if (renderer_)
    for (const std::string& one : renderer_->warm()) record.add_warm(one);
  for (std::size_t i = 0; i < rays_.of.size(); ++i) {
    if (rays_.of[i].packets == 0) continue;
    v1::RayCount& kind = *record.add_rays();
    kind.set_kind(ray_kind_names[i]);
    kind.set_rays(rays_.of[i].rays);
    kind.set_packets(rays_.of[i].packets);
  }
  return record;
}

}  // namespace metamer::worker
