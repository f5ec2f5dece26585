#include "client/cli/commands.h"
#include "client/cli/connection.h"
#include "client/cli/follow.h"
#include "client/cli/scene_input.h"
#include "client/cli/shared_options.h"
#include "client/tools/text/job_text.h"

namespace metamer::cli {
namespace {

struct CheckOptions {
  CommonOptions common;
  std::string scene;
  Overrides overrides;
};

/// Lets the server compile and plan: it alone reads meshes and knows the models' parameters.
boost::asio::awaitable<ExitCode> check_on(Session& session, const CheckedScene& scene,
                                          Report& report) {
  const Submission submission = make_submission(scene.scene(), scene.assets(), scene.name(), true);
  const Answer<std::uint64_t> job_id = co_await session.submit(submission);
  if (!job_id) co_return report.session_error(job_id.error());

  const Answer<JobRecord> job = co_await follow(session, *job_id, JobParts::plan);
  if (!job) co_return report.session_error(job.error());

  const ExitCode code = conclude(*job, &scene, report);
  if (code == ExitCode::done && job->plan) report.line("good: " + describe(*job->plan));
  co_return code;
}

ExitCode run(const CheckOptions& options) {
  Report report(options.common.json);
  const auto scene = load_scene(options.scene, options.overrides, report);
  if (!scene) return report.finish(ExitCode::bad_input);
  return report.finish(with_any_server(options.common, report, [&](Session& session, Interrupts&) {
    return check_on(session, *scene, report);
  }));
}

void declare(CheckOptions& values, Options& options) {
  declare_scene(values.scene, options);
  declare_overrides(values.overrides, options);
  declare_common(values.common, options);
}

}  // namespace

Command commands::check() {
  return make_command<CheckOptions>(
      "check", "say what is wrong with a scene, or what would be rendered", declare, run);
}

}  // namespace metamer::cli
