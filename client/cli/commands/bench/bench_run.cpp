#include "client/cli/commands/bench/bench_run.h"

#include <algorithm>
#include <array>
#include <cstdio>

#include "client/cli/connection.h"
#include "client/cli/overrides.h"
#include "common/scene/validate.h"

namespace metamer::cli {
namespace {

namespace asio = boost::asio;

/// Renders a scene and gives its timing. Errors: the session's; a job that does not finish.
asio::awaitable<Answer<v1::Timing>> time_scene(Session& session, const BenchCase& one) {
  Submission submission = make_submission(one.scene, {}, "bench " + one.name, false);
  for (const Upload& mesh : one.meshes) {
    v1::AssetName& asset = *submission.request.add_asset();
    asset.set_name(mesh.name);
    asset.set_sha256(std::string(to_bytes(mesh.sha256)));
    submission.uploads.push_back(mesh);
  }
  const Answer<std::uint64_t> job_id = co_await session.submit(submission);
  if (!job_id) co_return tl::unexpected<SessionError>(job_id.error());
  v1::Watch request;
  request.set_job_id(*job_id);
  v1::JobEvent last;
  const Session::OnEvent keep = [&](const v1::JobEvent& event) -> Answer<void> {
    last = event;
    return {};
  };
  const Answer<void> watched = co_await session.watch(request, keep);
  if (!watched) co_return tl::unexpected<SessionError>(watched.error());
  if (!last.has_finished())
    co_return session_error(SessionError::Kind::refused,
                            "the job did not finish: " + last.failed().reason());
  co_return last.finished().timing();
}

/// Drivers compile what is first run, also by the size of pictures, and files come into the store.
asio::awaitable<Answer<void>> warm_up(Session& session, const std::vector<BenchCase>& cases) {
  for (BenchCase one : cases) {
    one.scene.mutable_settings()->set_spp(1);
    const Answer<v1::Timing> timing = co_await time_scene(session, one);
    if (!timing) co_return tl::unexpected<SessionError>(timing.error());
  }
  co_return Answer<void>();
}

asio::awaitable<Answer<std::vector<Measured>>> measure(Session& session,
                                                       const std::vector<BenchCase>& cases,
                                                       std::uint32_t rounds) {
  const Answer<void> warm = co_await warm_up(session, cases);
  if (!warm) co_return tl::unexpected<SessionError>(warm.error());
  std::vector<Measured> measured(cases.size());
  for (std::uint32_t round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const Answer<v1::Timing> timing = co_await time_scene(session, cases[i]);
      if (!timing) co_return tl::unexpected<SessionError>(timing.error());
      measured[i].seconds.push_back(timing->render());
      measured[i].models.push_back(timing->models());
    }
  }
  co_return measured;
}

/// The options in place of the cases' settings. False: they make no sense, and it is said.
bool apply_to(std::vector<BenchCase>& cases, const Overrides& overrides, Report& report) {
  for (BenchCase& one : cases) {
    const auto replaced = apply(overrides, one.scene);
    if (!replaced) {
      report.problem(replaced.error(), {});
      return false;
    }
    const std::vector<Problem> problems = validate_scene(one.scene);
    for (const Problem& wrong : problems) report.problem(wrong, {});
    if (!problems.empty()) return false;
  }
  return true;
}

void print_rows(const std::vector<BenchCase>& cases, const std::vector<Measured>& measured,
                Report& report) {
  std::array<char, 160> text{};
  Json& rows = report.document()["cases"];
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const double ratio = median(relative(measured[i], measured[0]));
    const double share = median(measured[i].models), seconds = median(measured[i].seconds);
    std::snprintf(text.data(), text.size(), "%-32s %10.3f %6.1f %% %8.3f", cases[i].name.c_str(),
                  ratio, 100 * share, seconds);
    report.line(text.data());
    rows.push_back(
        {{"name", cases[i].name}, {"relative", ratio}, {"models", share}, {"seconds", seconds}});
  }
}

}  // namespace

void declare_bench(BenchOptions& bench, Options& options) {
  options.push_back({.names = "--rounds",
                     .target = &bench.rounds,
                     .meaning = "renderings of each",
                     .shows_default = true,
                     .range = {{1, 1000}}});
  declare_overrides(bench.overrides, options);
  declare_common(bench.common, options);
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

std::vector<double> relative(const Measured& one, const Measured& base) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < one.seconds.size(); ++i)
    ratios.push_back(one.seconds[i] / base.seconds[i]);
  return ratios;
}

ExitCode refuse_bench(const BenchOptions& options, const std::string& why) {
  Report report(options.common.json);
  report.error(why);
  return report.finish(ExitCode::bad_input);
}

ExitCode run_bench(const BenchOptions& options, std::vector<std::vector<BenchCase>> groups,
                   const BenchTable& table) {
  Report report(options.common.json);
  for (std::vector<BenchCase>& cases : groups)
    if (!apply_to(cases, options.overrides, report)) return report.finish(ExitCode::bad_input);
  const auto run = [&](Session& session, Interrupts&) -> asio::awaitable<ExitCode> {
    report.line(bench_scene_text(groups[0][0].scene, session.welcome().capabilities()) + ", " +
                std::to_string(options.rounds) + (options.rounds == 1 ? " round" : " rounds") +
                "; medians. " + table.legend);
    report.line(table.head);
    for (const std::vector<BenchCase>& cases : groups) {
      const Answer<std::vector<Measured>> measured =
          co_await measure(session, cases, options.rounds);
      if (!measured) co_return report.session_error(measured.error());
      table.print(cases, *measured, report);
    }
    co_return ExitCode::done;
  };
  return report.finish(with_any_server(options.common, report, run));
}

ExitCode compare_cases(const BenchOptions& options, std::vector<BenchCase> cases) {
  BenchTable table;
  table.legend =
      "Relative to " + cases[0].name + "; models: the share of the rendering that evaluates them.";
  std::array<char, 160> head{};
  std::snprintf(head.data(), head.size(), "%-32s %10s %8s %8s", "case", "relative", "models",
                "seconds");
  table.head = head.data();
  table.print = print_rows;
  return run_bench(options, {std::move(cases)}, table);
}

}  // namespace metamer::cli
