#include <cstdio>

#include "client/cli/commands.h"
#include "client/cli/connection.h"
#include "client/cli/follow.h"
#include "client/cli/scene_input.h"
#include "client/cli/shared_options.h"
#include "client/tools/text/formatted.h"
#include "client/tools/text/promise_text.h"
#include "common/scene/methods.h"

namespace metamer::cli {
namespace {

struct ExplainOptions {
  CommonOptions common;
  std::string scene;
  Overrides overrides;
};

double seconds(const v1::Prediction& prediction) {
  return prediction.prepare() + prediction.render();
}

/// Seconds that the naive way takes: what the others are compared with; 0 where it is not listed.
double rgb_seconds(const v1::Plan& plan) {
  for (const v1::Prediction& one : plan.prediction())
    if (one.method().has_rgb()) return seconds(one);
  return 0;
}

void print_needs(const v1::Plan& plan, Report& report) {
  report.line("The scene needs");
  for (const std::string& need : plan.need()) report.line("  " + need);
  if (plan.unneeded().empty()) return;
  report.line("and nothing needs");
  for (const std::string& unneeded : plan.unneeded()) report.line("  " + unneeded);
}

void print_predictions(const v1::Plan& plan, Report& report) {
  if (plan.prediction().empty()) return;
  report.line("");
  report.line(
      formatted("Predicted from %u of %llu pixels; ΔE00 against the reference; white is what "
                "faces the dominant light:",
                plan.prediction(0).error().pixels(),
                static_cast<unsigned long long>(plan.width()) * plan.height()));
  report.line(
      "  method                        seconds   ÷ rgb      mean      95 %       max  any color");
  const double rgb = rgb_seconds(plan);
  for (const v1::Prediction& one : plan.prediction()) {
    const v1::ColorError& error = one.error();
    report.line((one.chosen() ? "* " : "  ") +
                formatted("%-28s %8.3f %7.3f %9.4f %9.4f %9.4f  %9.4f",
                          method_text(one.method()).c_str(), seconds(one),
                          rgb > 0 ? seconds(one) / rgb : 0.0, error.mean(), error.percentile_95(),
                          error.maximum(), one.bound()));
  }
  report.line(
      "\"any color\": the largest of one light on one surface that faces it, in the picture or "
      "not; "
      "*: the scene's own method.");
  if (plan.prediction(0).has_noise())
    report.line("Beside that, whatever the method, the " + noise_text(plan.prediction(0).noise()) +
                ".");
}

boost::asio::awaitable<ExitCode> explain_on(Session& session, const CheckedScene& scene,
                                            Report& report) {
  Submission submission = make_submission(scene.scene(), scene.assets(), scene.name(), true);
  submission.request.set_explain(true);
  const Answer<std::uint64_t> job_id = co_await session.submit(submission);
  if (!job_id) co_return report.session_error(job_id.error());

  const Answer<JobRecord> job = co_await follow(session, *job_id, JobParts::plan);
  if (!job) co_return report.session_error(job.error());
  const ExitCode code = conclude(*job, &scene, report);
  if (code != ExitCode::done || !job->plan) co_return code;
  print_needs(*job->plan, report);
  print_predictions(*job->plan, report);
  co_return code;
}

ExitCode run(const ExplainOptions& options) {
  Report report(options.common.json);
  const auto scene = load_scene(options.scene, options.overrides, report);
  if (!scene) return report.finish(ExitCode::bad_input);
  return report.finish(with_any_server(options.common, report, [&](Session& session, Interrupts&) {
    return explain_on(session, *scene, report);
  }));
}

void declare(ExplainOptions& values, Options& options) {
  declare_scene(values.scene, options);
  declare_overrides(values.overrides, options);
  declare_common(values.common, options);
}

}  // namespace

Command commands::explain() {
  return make_command<ExplainOptions>(
      "explain", "say what a scene needs, and what each method would cost and miss", declare, run);
}

}  // namespace metamer::cli
