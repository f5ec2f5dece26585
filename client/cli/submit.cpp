#include "client/cli/commands.h"
#include "client/cli/connection.h"
#include "client/cli/output.h"
#include "client/cli/scene_input.h"
#include "common/scene/feature_sets.h"

namespace metamer::cli {
namespace {

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

}  // namespace

ExitCode submit(const SubmitOptions& options) {
  Report report(options.common.json);
  const auto scene = load_scene(options.scene, options.overrides, report);
  if (!scene) return report.finish(ExitCode::bad_input);
  return report.finish(with_server(options.common, report, [&](Session& session) {
    return submit_to(session, *scene, options.keep_factors, report);
  }));
}

}  // namespace metamer::cli
