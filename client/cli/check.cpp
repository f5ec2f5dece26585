#include "client/cli/commands.h"
#include "client/cli/connection.h"
#include "client/cli/follow.h"
#include "client/cli/scene_input.h"

namespace metamer::cli {
namespace {

/// Lets the server compile and plan: it alone reads meshes and knows the models' parameters.
boost::asio::awaitable<ExitCode> check_on(Session& session, const SceneInput& scene,
                                          Report& report) {
  const Submission submission = make_submission(scene.scene(), scene.assets(), scene.name(), true);
  const Answer<std::uint64_t> job_id = co_await session.submit(submission);
  if (!job_id) co_return report.session_error(job_id.error());

  const Answer<Followed> followed = co_await follow(session, *job_id, Wanted::plan);
  if (!followed) co_return report.session_error(followed.error());

  const ExitCode code = conclude(*followed, &scene, report);
  if (code == ExitCode::done && followed->plan) report.line("good: " + describe(*followed->plan));
  co_return code;
}

}  // namespace

ExitCode check(const CheckOptions& options) {
  Report report(options.common.json);
  const auto scene = SceneInput::load(options.scene, options.overrides, report);
  if (!scene) return report.finish(ExitCode::bad_input);
  return report.finish(with_any_server(options.common, report, [&](Session& session, Interrupts&) {
    return check_on(session, *scene, report);
  }));
}

}  // namespace metamer::cli
