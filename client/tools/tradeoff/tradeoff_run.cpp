#include "client/tools/tradeoff/tradeoff_run.h"

#include <algorithm>
#include <utility>

#include "client/session/job_record.h"
#include "client/session/submission.h"
#include "common/color/srgb.h"
#include "common/image/compare.h"
#include "common/scene/methods.h"

namespace metamer::client {
namespace {

namespace asio = boost::asio;

template <class T>
using Stopped = tl::expected<T, TradeoffStop>;

tl::unexpected<TradeoffStop> stop(SessionError error) {
  return tl::unexpected<TradeoffStop>(
      {.kind = TradeoffStop::Kind::session, .error = std::move(error)});
}

tl::unexpected<TradeoffStop> stop(TradeoffStop::Kind kind, Problem problem = {}) {
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

/// What a run works with.
struct Run {
  Session& session;
  const TradeoffScene& scene;
  const TradeoffCalls& calls;
};

/// A job that ended.
struct Outcome {
  std::string failure;  ///< Empty: there is a picture.
  JobRecord job;
};

/// Renders the scene by a method. A refusal is an outcome.
asio::awaitable<Stopped<Outcome>> render_by(const Run& run, const v1::Method& method,
                                            const std::string& name) {
  v1::Scene scene = run.scene.scene;
  scene.mutable_settings()->clear_goal();
  *scene.mutable_settings()->mutable_method() = method;
  const Submission submission =
      make_submission(scene, run.scene.assets, "tradeoff: " + name, false);
  Outcome outcome;
  Answer<std::uint64_t> job_id = co_await run.session.submit(submission);
  if (!job_id && job_id.error().kind == SessionError::Kind::refused) {
    outcome.failure = job_id.error().message;
    co_return Stopped<Outcome>(std::move(outcome));
  }
  if (!job_id) co_return stop(std::move(job_id.error()));

  run.calls.job(*job_id);
  Answer<JobRecord> job = co_await record_job(run.session, *job_id, JobParts::picture);
  run.calls.job({});
  if (!job) co_return stop(std::move(job.error()));
  if (job->last.has_cancelled()) co_return stop(TradeoffStop::Kind::cancelled);
  if (job->last.has_failed()) outcome.failure = reason_of(job->last.failed());
  outcome.job = std::move(*job);
  co_return Stopped<Outcome>(std::move(outcome));
}

/// Compares a picture with the reference, and draws the difference.
Result<Image> measure(const Image& image, const Image& reference, const Xyz& white,
                      TradeoffRow& row) {
  const auto difference = compare(image, reference, Metric::de00, white);
  if (!difference) return tl::unexpected<Problem>(difference.error());
  row.error = difference->statistics;
  return false_color(*difference, Metric::de00, 0,
                     method_text(row.what.settings) + ", against the reference");
}

void keep_cheapest(const v1::Timing& timing, bool first, TradeoffRow& row) {
  if (!first && timing.prepare() + timing.render() >= row.seconds()) return;
  row.prepare = timing.prepare();
  row.render = timing.render();
}

/// One round of one case.
asio::awaitable<Stopped<void>> run_case(const Run& run, const Image& reference, bool first,
                                        const Xyz& white, TradeoffRow& row) {
  const Stopped<Outcome> outcome = co_await render_by(run, row.what.settings, row.what.stem);
  if (!outcome) co_return tl::unexpected<TradeoffStop>(outcome.error());
  row.failure = outcome->failure;
  if (!row.failure.empty()) co_return Stopped<void>();
  keep_cheapest(outcome->job.last.finished().timing(), first, row);
  if (!first) co_return Stopped<void>();
  const Result<void> measured =
      measure(outcome->job.film->image(), reference, white, row).and_then([&](const Image& drawn) {
        return run.calls.measured(row, drawn);
      });
  if (!measured) co_return stop(TradeoffStop::Kind::picture, measured.error());
  co_return Stopped<void>();
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

asio::awaitable<tl::expected<Tradeoff, TradeoffStop>> run_tradeoff(Session& session,
                                                                   const TradeoffScene& scene,
                                                                   unsigned rounds,
                                                                   const TradeoffCalls& calls) {
  const Run run{session, scene, calls};
  Tradeoff tradeoff;
  tradeoff.scene = scene.name;
  tradeoff.rounds = rounds;

  // The reference, which says what white is.
  calls.round(0, tradeoff);
  const Stopped<Outcome> reference = co_await render_by(run, tradeoff_reference(), "the reference");
  if (!reference) co_return tl::unexpected<TradeoffStop>(reference.error());
  if (!reference->failure.empty())
    co_return stop(TradeoffStop::Kind::reference, problem(reference->failure).value());
  tradeoff.plan = *reference->job.plan;
  const std::optional<Xyz> white = lit_white(tradeoff.plan, scene.scene);
  tradeoff.white = white.value_or(srgb::to_xyz({1, 1, 1}));
  tradeoff.white_of_plan = white.has_value();
  const v1::Timing& timing = reference->job.last.finished().timing();
  tradeoff.reference_seconds = timing.prepare() + timing.render();

  // The cases, round by round.
  for (TradeoffCase& one : tradeoff_cases()) {
    tradeoff.rows.emplace_back();
    tradeoff.rows.back().what = std::move(one);
  }
  for (unsigned round = 1; round <= rounds; ++round) {
    calls.round(round, tradeoff);
    for (TradeoffRow& row : tradeoff.rows) {
      if (!row.failure.empty()) continue;
      Stopped<void> done =
          co_await run_case(run, reference->job.film->image(), round == 1, tradeoff.white, row);
      if (!done) co_return tl::unexpected<TradeoffStop>(std::move(done.error()));
    }
  }
  mark_front(tradeoff.rows);
  co_return Stopped<Tradeoff>(std::move(tradeoff));
}

}  // namespace metamer::client
