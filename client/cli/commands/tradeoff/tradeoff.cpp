// Every method on one scene: a table, and a folder of what was found.
#include <boost/asio/this_coro.hpp>
#include <filesystem>
#include <iostream>

#include "client/cli/commands.h"
#include "client/cli/commands/tradeoff/tradeoff_texts.h"
#include "client/cli/connection.h"
#include "client/cli/follow.h"
#include "client/cli/output/gnuplot.h"
#include "client/cli/overrides.h"
#include "client/cli/scene_input.h"
#include "client/cli/shared_options.h"
#include "client/tools/text/formatted.h"
#include "client/tools/tradeoff/tradeoff_run.h"

namespace metamer::cli {
namespace {

namespace asio = boost::asio;
namespace fs = std::filesystem;
using client::Tradeoff;
using client::TradeoffRow;
using client::TradeoffStop;

struct TradeoffOptions {
  CommonOptions common;
  std::string scene;
  Overrides overrides;  ///< But for the method.
  std::string folder;   ///< Made when it is not there.
  std::uint32_t rounds = 3;
};

fs::path difference_file(const fs::path& folder, const TradeoffRow& row) {
  return folder / ("diff-" + row.what.stem + ".png");
}

void say_round(unsigned round, const Tradeoff& so_far, Report& report) {
  if (round == 1 && !so_far.white_of_plan)
    report.note({.field = {},
                 .file = {},
                 .message = "the plan has no white of the dominant light; that of D65 stands in"});
  std::cerr << (round == 0
                    ? "the reference"
                    : "round " + std::to_string(round) + " of " + std::to_string(so_far.rounds))
            << '\n';
}

/// Says why there are no results. Returns the exit code that it means.
ExitCode report_stop(const TradeoffStop& stop, Report& report) {
  switch (stop.kind) {
    case TradeoffStop::Kind::session:
      return report.session_error(stop.error);
    case TradeoffStop::Kind::cancelled:
      report.error("cancelled");
      return ExitCode::cancelled;
    case TradeoffStop::Kind::reference:
      report.error("the reference can't be rendered: " + stop.problem.message);
      return ExitCode::job_failed;
    case TradeoffStop::Kind::picture:
      report.problem(stop.problem, {});
      return ExitCode::other;
  }
  return ExitCode::other;
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
  keep(folder / "tradeoff.csv",
       write_text_file(folder / "tradeoff.csv", client::tradeoff_csv(tradeoff)));
  keep(folder / "tradeoff.json", write_text_file(folder / "tradeoff.json", json + "\n"));
  keep(folder / "tradeoff.png", draw_png(tradeoff_script(tradeoff), folder / "tradeoff.png"));
  for (const TradeoffRow& row : tradeoff.rows)
    if (row.failure.empty()) keep(difference_file(folder, row), {});
  return code;
}

ExitCode report_results(const Tradeoff& tradeoff, const fs::path& folder, Report& report) {
  for (const std::string& line : tradeoff_table(tradeoff)) report.line(line);
  report.line(client::formatted("reference: %.4f s; white X %.4f Y %.4f Z %.4f",
                                tradeoff.reference_seconds, tradeoff.white[0], tradeoff.white[1],
                                tradeoff.white[2]));
  report.document().update(tradeoff_json(tradeoff));
  return write_results(tradeoff, folder, report);
}

asio::awaitable<ExitCode> tradeoff_on(Session& session, Interrupts& interrupts,
                                      const client::TradeoffScene& scene,
                                      const TradeoffOptions& options, Report& report) {
  const auto executor = co_await asio::this_coro::executor;
  client::TradeoffCalls calls;
  calls.round = [&](unsigned round, const Tradeoff& so_far) { say_round(round, so_far, report); };
  calls.job = [&](std::optional<std::uint64_t> job_id) {
    if (!job_id) return interrupts.on_first({});
    interrupts.on_first(
        [&session, executor, id = *job_id] { request_cancel(executor, session, id); });
  };
  calls.measured = [&](const TradeoffRow& row, const Image& difference) {
    return write_image(difference, difference_file(options.folder, row), false, {})
        .map([](const GamutReport&) {});
  };
  const auto tradeoff = co_await client::run_tradeoff(session, scene, options.rounds, calls);
  co_return tradeoff ? report_results(*tradeoff, options.folder, report)
                     : report_stop(tradeoff.error(), report);
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
  const client::TradeoffScene sent{scene->scene(), scene->assets(), scene->name()};
  const ExitCode code =
      with_any_server(options.common, report, [&](Session& session, Interrupts& interrupts) {
        return tradeoff_on(session, interrupts, sent, options, report);
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
