#include "client/cli/commands.h"
#include "client/cli/connection.h"
#include "client/cli/output/output.h"
#include "client/cli/scene_input.h"
#include "client/cli/shared_options.h"
#include "common/scene/feature_sets.h"

namespace metamer::cli {
namespace {

struct SubmitOptions {
  CommonOptions common;
  std::string scene;
  Overrides overrides;
  bool keep_factors = false;
};

boost::asio::awaitable<ExitCode> submit_to(Session& session, const CheckedScene& scene,
                                           bool keep_factors, Report& report) {
  if (keep_factors && !has_feature(session.welcome().capabilities(),
                                   scene.scene().settings().backend(), Feature::factors)) {
    report.problem(factors_by_gl(), {});
    co_return ExitCode::bad_input;
  }
  Submission submission = make_submission(scene.scene(), scene.assets(), scene.name(), false);
  submission.request.set_keep_factors(keep_factors);
  const Answer<std::uint64_t> job_id = co_await session.submit(submission);
  if (!job_id) co_return report.session_error(job_id.error());
  report.document()["job_id"] = *job_id;
  report.line(std::to_string(*job_id));
  co_return ExitCode::done;
}

ExitCode run(const SubmitOptions& options) {
  Report report(options.common.json);
  const auto scene = load_scene(options.scene, options.overrides, report);
  if (!scene) return report.finish(ExitCode::bad_input);
  return report.finish(with_server(options.common, report, [&](Session& session) {
    return submit_to(session, *scene, options.keep_factors, report);
  }));
}

void declare(SubmitOptions& values, Options& options) {
  declare_scene(values.scene, options);
  declare_overrides(values.overrides, options);
  options.push_back({.names = "--keep-factors",
                     .target = &values.keep_factors,
                     .meaning = "keep what relighting needs: fetch it by the same word"});
  declare_common(values.common, options);
}

}  // namespace

Command commands::submit() {
  return make_command<SubmitOptions>("submit", "queue a scene; prints the job's number", declare,
                                     run);
}

}  // namespace metamer::cli
