// Every method on one scene. All pictures are rendered by the same server, one after the other,
// round by round: what else the machine does then slows all of them, and the minimum forgets it.
#include "client/cli/commands/tradeoff/tradeoff.h"

#include <boost/asio/this_coro.hpp>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <optional>

#include "client/cli/commands.h"
#include "client/cli/connection.h"
#include "client/cli/follow.h"
#include "client/cli/output/gnuplot.h"
#include "client/cli/overrides.h"
#include "client/cli/scene_input.h"
#include "client/cli/shared_options.h"
#include "common/color/srgb.h"
#include "common/image/compare.h"
#include "common/scene/methods.h"

namespace metamer::cli {
namespace {

namespace asio = boost::asio;
namespace fs = std::filesystem;

struct TradeoffOptions {
  CommonOptions common;
  std::string scene;
  Overrides overrides;  ///< But for the method.
  std::string folder;   ///< Made when it is not there.
  std::uint32_t rounds = 3;
};

/// Why a job gave no picture; empty: it gave one.
std::string reason_of(const v1::Failed& failed) {
  std::string reason = failed.reason();
  for (const v1::Problem& problem : failed.problem())
    reason += (reason.empty() ? "" : ": ") +
              (problem.field().empty() ? "" : problem.field() + ": ") + problem.message();
  return reason.empty() ? "the job failed" : reason;
}

/// What a run works with.
struct Bench {
  Session& session;
  Interrupts& interrupts;
  const CheckedScene& scene;
  const TradeoffOptions& options;
};

/// A job that ended.
struct Outcome {
  std::string failure;  ///< Empty: there is a picture, or it was cancelled.
  JobRecord job;
};

/// Renders the scene by a method. Errors: the session's, but for a refusal, which is an outcome.
asio::awaitable<Answer<Outcome>> render_by(const Bench& bench, const v1::Method& method,
                                           const std::string& name) {
  v1::Scene scene = bench.scene.scene();
  *scene.mutable_settings()->mutable_method() = method;
  const Submission submission =
      make_submission(scene, bench.scene.assets(), "tradeoff: " + name, false);
  Outcome outcome;
  const Answer<std::uint64_t> job_id = co_await bench.session.submit(submission);
  if (!job_id && job_id.error().kind == SessionError::Kind::refused) {
    outcome.failure = job_id.error().message;
    co_return Answer<Outcome>(std::move(outcome));
  }
  if (!job_id) co_return tl::unexpected<SessionError>(job_id.error());

  const auto executor = co_await asio::this_coro::executor;
  bench.interrupts.on_first([&session = bench.session, executor, id = *job_id] {
    request_cancel(executor, session, id);
  });
  Answer<JobRecord> job = co_await record_job(bench.session, *job_id, JobParts::picture);
  bench.interrupts.on_first({});
  if (!job) co_return tl::unexpected<SessionError>(job.error());
  if (job->last.has_failed()) outcome.failure = reason_of(job->last.failed());
  outcome.job = std::move(*job);
  co_return Answer<Outcome>(std::move(outcome));
}

/// A perfect white that faces the dominant light; sRGB's where the server gives none, which is
/// said.
Xyz white_of(const v1::Plan& plan, const v1::Scene& scene, Report& report) {
  const auto& white = plan.source_white();
  if (white.size() != 3 || !(white[0] > 0) || !(white[1] > 0) || !(white[2] > 0)) {
    Problem note;
    note.message = "the plan has no white of the dominant light; that of D65 stands in";
    report.note(note);
    return srgb::to_xyz({1, 1, 1});
  }
  const v1::Light& light = scene.light(0);
  const double luminance = light.has_luminance() && light.luminance() > 0 ? light.luminance() : 1;
  return {luminance * white[0], luminance * white[1], luminance * white[2]};
}

/// Compares a picture with the reference and draws the difference. Error: it can't be written.
Result<void> measure(const Image& image, const Image& reference, const Tradeoff& tradeoff,
                     const fs::path& folder, TradeoffRow& row) {
  const auto difference = metamer::compare(image, reference, Metric::de00, tradeoff.white);
  if (!difference) return tl::unexpected<Problem>(difference.error());
  row.error = difference->statistics;
  return false_color(*difference, Metric::de00, 0,
                     method_text(row.what.settings) + ", against the reference")
      .and_then([&](const Image& drawn) {
        return write_image(drawn, folder / ("diff-" + row.what.stem + ".png"), false, {});
      })
      .map([](const GamutReport&) {});
}

void keep_cheapest(const v1::Timing& timing, bool first, TradeoffRow& row) {
  if (!first && timing.prepare() + timing.render() >= row.seconds()) return;
  row.prepare = timing.prepare();
  row.render = timing.render();
}

void say(const std::string& text) { std::cerr << text << '\n'; }

/// All rounds of all cases. Gives the exit code of what went wrong.
asio::awaitable<ExitCode> run_cases(const Bench& bench, const Image& reference, Tradeoff& tradeoff,
                                    Report& report) {
  for (unsigned round = 1; round <= tradeoff.rounds; ++round) {
    say("round " + std::to_string(round) + " of " + std::to_string(tradeoff.rounds));
    for (TradeoffRow& row : tradeoff.rows) {
      if (!row.failure.empty()) continue;
      const Answer<Outcome> outcome = co_await render_by(bench, row.what.settings, row.what.stem);
      if (!outcome) co_return report.session_error(outcome.error());
      if (outcome->job.last.has_cancelled()) {
        report.error("cancelled");
        co_return ExitCode::cancelled;
      }
      row.failure = outcome->failure;
      if (!row.failure.empty()) continue;
      keep_cheapest(outcome->job.last.finished().timing(), round == 1, row);
      if (round > 1) continue;
      const Result<void> measured =
          measure(outcome->job.film->image(), reference, tradeoff, bench.options.folder, row);
      if (!measured) {
        report.problem(measured.error(), {});
        co_return ExitCode::other;
      }
    }
  }
  co_return ExitCode::done;
}

ExitCode write_results(const Tradeoff& tradeoff, const fs::path& folder, Report& report) {
  const std::string json =
      tradeoff_json(tradeoff).dump(2, ' ', false, Json::error_handler_t::replace);
  ExitCode code = ExitCode::done;
  const auto keep = [&](const fs::path& file, const Result<void>& written) {
    if (written) {
      report.document()["files"].push_back(file.string());
      report.line(file.string());
      return;
    }
    report.problem(written.error(), {});
    code = ExitCode::other;
  };
  keep(folder / "tradeoff.csv", write_text_file(folder / "tradeoff.csv", tradeoff_csv(tradeoff)));
  keep(folder / "tradeoff.json", write_text_file(folder / "tradeoff.json", json + "\n"));
  keep(folder / "tradeoff.png", draw_png(tradeoff_script(tradeoff), folder / "tradeoff.png"));
  for (const TradeoffRow& row : tradeoff.rows)
    if (row.failure.empty()) keep(folder / ("diff-" + row.what.stem + ".png"), {});
  return code;
}

asio::awaitable<ExitCode> tradeoff_on(const Bench& bench, Report& report) {
  // The reference also warms the worker up.
  say("the reference");
  const Answer<Outcome> reference =
      co_await render_by(bench, tradeoff_reference(), "the reference");
  if (!reference) co_return report.session_error(reference.error());
  const bool cancelled = reference->job.last.has_cancelled();
  if (cancelled || !reference->failure.empty()) {
    report.error(cancelled ? "cancelled"
                           : "the reference can't be rendered: " + reference->failure);
    co_return cancelled ? ExitCode::cancelled : ExitCode::job_failed;
  }
  Tradeoff tradeoff;
  tradeoff.scene = bench.scene.name();
  tradeoff.plan = *reference->job.plan;
  tradeoff.white = white_of(tradeoff.plan, bench.scene.scene(), report);
  tradeoff.rounds = bench.options.rounds;
  const v1::Timing& timing = reference->job.last.finished().timing();
  tradeoff.reference_seconds = timing.prepare() + timing.render();
  for (TradeoffCase& one : tradeoff_cases()) {
    tradeoff.rows.emplace_back();
    tradeoff.rows.back().what = std::move(one);
  }

  const ExitCode code = co_await run_cases(bench, reference->job.film->image(), tradeoff, report);
  if (code != ExitCode::done) co_return code;
  mark_front(tradeoff.rows);
  for (const std::string& line : tradeoff_table(tradeoff)) report.line(line);
  char text[80];
  std::snprintf(text, sizeof text, "reference: %.4f s; white X %.4f Y %.4f Z %.4f",
                tradeoff.reference_seconds, tradeoff.white[0], tradeoff.white[1],
                tradeoff.white[2]);
  report.line(text);
  report.document().update(tradeoff_json(tradeoff));
  co_return write_results(tradeoff, bench.options.folder, report);
}

/// Whether the options make sense here; says why not.
bool check_options(const TradeoffOptions& options, Report& report) {
  if (choose_a_method(options.overrides)) {
    report.error("tradeoff runs every method: options that choose one are not for it");
    return false;
  }
  std::error_code error;
  fs::create_directories(options.folder, error);
  if (fs::is_directory(options.folder)) return true;
  report.error("--output: can't make the folder " + quoted(options.folder) + ": " +
               error.message());
  return false;
}

ExitCode run(const TradeoffOptions& options) {
  Report report(options.common.json);
  if (!check_options(options, report)) return report.finish(ExitCode::bad_input);
  const auto scene = load_scene(options.scene, options.overrides, report);
  if (!scene) return report.finish(ExitCode::bad_input);
  const ExitCode code =
      with_any_server(options.common, report,
                      [&](Session& session, Interrupts& interrupts) -> asio::awaitable<ExitCode> {
                        const Bench bench{session, interrupts, *scene, options};
                        co_return co_await tradeoff_on(bench, report);
                      });
  return report.finish(code);
}

void declare(TradeoffOptions& values, Options& options) {
  declare_scene(values.scene, options);
  options.push_back(
      {.names = "-o,--output",
       .target = &values.folder,
       .meaning = "the folder for tradeoff.csv, .json, .png and the pictures of the differences",
       .required = true});
  options.push_back({.names = "--rounds",
                     .target = &values.rounds,
                     .meaning = "renderings of each; the quickest counts",
                     .shows_default = true,
                     .range = {{1, 1000}}});
  declare_overrides(values.overrides, options);
  declare_common(values.common, options);
}

}  // namespace

Command commands::tradeoff() {
  return make_command<TradeoffOptions>(
      "tradeoff", "what every method costs and how far it is off, on a scene of yours", declare,
      run);
}

}  // namespace metamer::cli
