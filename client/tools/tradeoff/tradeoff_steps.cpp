#include "client/tools/tradeoff/tradeoff_steps.h"

#include <algorithm>
#include <utility>

#include "common/color/srgb.h"
#include "common/image/compare.h"
#include "common/scene/methods.h"

namespace metamer::client {
namespace {

using StepDone = tl::expected<void, TradeoffStop>;

StepDone stop(TradeoffStop::Kind kind, Problem problem = {}) {
  return tl::unexpected<TradeoffStop>({.kind = kind, .problem = std::move(problem)});
}

/// Why a job gave no picture.
std::string reason_of(const v1::Failed& failed) {
  std::string reason = failed.reason();
  for (const v1::Problem& problem : failed.problem())
    reason += (reason.empty() ? "" : ": ") +
              (problem.field().empty() ? "" : problem.field() + ": ") + problem.message();
  return reason.empty() ? "the job failed" : reason;
}

void keep_cheapest(const v1::Timing& timing, bool first, TradeoffRow& row) {
  if (!first && timing.prepare() + timing.render() >= row.seconds()) return;
  row.prepare = timing.prepare();
  row.render = timing.render();
}

/// Compares a picture with the reference.
Result<void> measure(const Image& image, const Image& reference, const Xyz& white,
                     const TradeoffMeasured& measured, TradeoffRow& row) {
  const auto difference = compare(image, reference, Metric::de00, white);
  if (!difference) return tl::unexpected<Problem>(difference.error());
  row.error = difference->statistics;
  if (!measured) return {};
  return false_color(*difference, Metric::de00, 0,
                     method_text(row.what.settings) + ", against the reference")
      .and_then([&](const Image& drawn) { return measured(row, drawn); });
}

}  // namespace

std::optional<Xyz> lit_white(const v1::Plan& plan, const v1::Scene& scene) {
  const auto& white = plan.source_white();
  if (white.size() != 3 || scene.light().empty() ||
      !std::all_of(white.begin(), white.end(), [](double value) { return value > 0; }))
    return std::nullopt;
  const v1::Light& light = scene.light(0);
  const double luminance = light.has_luminance() && light.luminance() > 0 ? light.luminance() : 1;
  return Xyz{luminance * white[0], luminance * white[1], luminance * white[2]};
}

TradeoffSteps::TradeoffSteps(const TradeoffScene& scene, unsigned rounds, TradeoffMeasured measured)
    : scene_(scene), measured_(std::move(measured)) {
  tradeoff_.scene = scene.name;
  tradeoff_.rounds = rounds;
  for (TradeoffCase& one : tradeoff_cases()) {
    tradeoff_.rows.emplace_back();
    tradeoff_.rows.back().what = std::move(one);
  }
}

std::string TradeoffSteps::due() const {
  return round_ == 0 ? "the reference" : tradeoff_.rows[row_].what.stem;
}

std::optional<Submission> TradeoffSteps::next() const {
  if (is_done()) return std::nullopt;
  v1::Scene scene = scene_.scene;
  scene.mutable_settings()->clear_goal();
  *scene.mutable_settings()->mutable_method() =
      round_ == 0 ? tradeoff_reference() : tradeoff_.rows[row_].what.settings;
  return make_submission(scene, scene_.assets, "tradeoff: " + due(), false);
}

StepDone TradeoffSteps::fail(const std::string& why) {
  if (round_ == 0) return stop(TradeoffStop::Kind::reference, problem(why).value());
  tradeoff_.rows[row_].failure = why;
  go_on();
  return {};
}

StepDone TradeoffSteps::refused(const std::string& why) { return fail(why); }

StepDone TradeoffSteps::ended(const JobRecord& job) {
  if (job.last.has_cancelled()) return stop(TradeoffStop::Kind::cancelled);
  if (job.last.has_failed()) return fail(reason_of(job.last.failed()));
  if (round_ == 0) return end_reference(job);
  TradeoffRow& row = tradeoff_.rows[row_];
  keep_cheapest(job.last.finished().timing(), round_ == 1, row);
  if (round_ == 1)
    if (const Result<void> measured =
            measure(job.film->image(), *reference_, tradeoff_.white, measured_, row);
        !measured)
      return stop(TradeoffStop::Kind::picture, measured.error());
  go_on();
  return {};
}

/// It says what white is.
StepDone TradeoffSteps::end_reference(const JobRecord& job) {
  tradeoff_.plan = *job.plan;
  const std::optional<Xyz> white = lit_white(tradeoff_.plan, scene_.scene);
  tradeoff_.white = white.value_or(srgb::to_xyz({1, 1, 1}));
  tradeoff_.white_of_plan = white.has_value();
  const v1::Timing& timing = job.last.finished().timing();
  tradeoff_.reference_seconds = timing.prepare() + timing.render();
  reference_ = job.film->image();
  round_ = 1;
  return {};
}

/// To the next row that has not failed, in this round or the next ones.
void TradeoffSteps::go_on() {
  do {
    if (++row_ < tradeoff_.rows.size()) continue;
    row_ = 0;
    ++round_;
  } while (!is_done() && !tradeoff_.rows[row_].failure.empty());
  if (is_done()) mark_front(tradeoff_.rows);
}

unsigned TradeoffSteps::jobs() const {
  return 1 + tradeoff_.rounds * static_cast<unsigned>(tradeoff_.rows.size());
}

unsigned TradeoffSteps::jobs_done() const {
  if (round_ == 0) return 0;
  return 1 + (round_ - 1) * static_cast<unsigned>(tradeoff_.rows.size()) +
         static_cast<unsigned>(row_);
}

}  // namespace metamer::client
