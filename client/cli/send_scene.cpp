#include "client/cli/send_scene.h"

#include "client/session/submission.h"
#include "common/scene/feature_sets.h"

namespace metamer::cli {

bool check_factors(const Session& session, const CheckedScene& scene, bool keep_factors,
                   Report& report) {
  if (!keep_factors || has_feature(session.welcome().capabilities(),
                                   scene.scene().settings().backend(), Feature::factors))
    return true;
  report.problem({.field = {},
                  .file = {},
                  .message = "--keep-factors and --exr spectral need what the cpu backend keeps "
                             "of each pixel: leave --backend gl out"},
                 {});
  return false;
}

boost::asio::awaitable<tl::expected<std::uint64_t, ExitCode>> send_scene(Session& session,
                                                                         const CheckedScene& scene,
                                                                         bool keep_factors,
                                                                         Report& report) {
  if (!check_factors(session, scene, keep_factors, report))
    co_return tl::unexpected(ExitCode::bad_input);
  Submission submission = make_submission(scene.scene(), scene.assets(), scene.name(), false);
  submission.request.set_keep_factors(keep_factors);
  Answer<std::uint64_t> job_id = co_await session.submit(submission);
  if (!job_id) co_return tl::unexpected(report.session_error(job_id.error()));
  co_return *job_id;
}

}  // namespace metamer::cli
