#include <algorithm>
#include <array>
#include <cstdio>
#include <vector>

#include "client/cli/bench_cases.h"
#include "client/cli/commands.h"
#include "client/cli/connection.h"
#include "client/cli/overrides.h"
#include "common/scene/settings.h"
#include "common/scene/validate.h"

namespace metamer::cli {
namespace {

namespace asio = boost::asio;

/// What one case took, a round each.
struct Measured {
  std::vector<double> seconds;  ///< Rendering alone.
  std::vector<double> models;   ///< The share of it that went into models, 0..1.
};

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

/// Renders a scene and gives its timing. Errors: the session's; a job that does not finish.
asio::awaitable<Answer<v1::Timing>> time_scene(Session& session, const BenchCase& one) {
  const Submission submission = make_submission(one.scene, {}, "bench " + one.name, false);
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

/// The times of each round relative to the first case's in the same round: what else the machine
/// does then slows both.
std::vector<double> relative(const Measured& one, const Measured& base) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < one.seconds.size(); ++i)
    ratios.push_back(one.seconds[i] / base.seconds[i]);
  return ratios;
}

void print_table(const std::vector<BenchCase>& cases, const std::vector<Measured>& measured,
                 Report& report) {
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), "%-32s %10s %8s %8s", "case", "relative", "models",
                "seconds");
  report.line(text.data());
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

asio::awaitable<ExitCode> bench_on(Session& session, const std::vector<BenchCase>& cases,
                                   const BenchOptions& options, Report& report) {
  std::vector<Measured> measured(cases.size());
  // The first round warms the worker up; the rounds interleave the cases.
  for (std::uint32_t round = 0; round <= options.rounds; ++round) {
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const Answer<v1::Timing> timing = co_await time_scene(session, cases[i]);
      if (!timing) co_return report.session_error(timing.error());
      if (round == 0) continue;
      measured[i].seconds.push_back(timing->render());
      measured[i].models.push_back(timing->models());
    }
  }
  report.line(bench_scene_text(cases[0].scene) + ", " + std::to_string(options.rounds) +
              (options.rounds == 1 ? " round" : " rounds") + "; medians. Relative to " +
              cases[0].name + "; models: the share of the rendering that evaluates them.");
  print_table(cases, measured, report);
  co_return ExitCode::done;
}

/// The cases with the options in place of their settings. Empty: they make no sense, and it is
/// said.
std::vector<BenchCase> cases_with(const Overrides& overrides, std::vector<BenchCase> cases,
                                  Report& report) {
  for (BenchCase& one : cases) {
    const auto replaced = apply(overrides, one.scene);
    if (!replaced) {
      report.problem(replaced.error(), {});
      return {};
    }
    const std::vector<Problem> problems = validate_scene(one.scene);
    for (const Problem& wrong : problems) report.problem(wrong, {});
    if (!problems.empty()) return {};
  }
  return cases;
}

ExitCode bench(const BenchOptions& options, std::vector<BenchCase> all) {
  Report report(options.common.json);
  const std::vector<BenchCase> cases = cases_with(options.overrides, std::move(all), report);
  if (cases.empty()) return report.finish(ExitCode::bad_input);
  return report.finish(with_any_server(options.common, report, [&](Session& session, Interrupts&) {
    return bench_on(session, cases, options, report);
  }));
}

}  // namespace

ExitCode bench_models(const BenchOptions& options) { return bench(options, model_cases()); }

ExitCode bench_methods(const BenchOptions& options) {
  return bench(options, method_cases(options.overrides.backend == "gl"));
}

}  // namespace metamer::cli
