#include "client/cli/commands.h"
#include "client/cli/connection.h"
#include "client/cli/output/output.h"
#include "client/cli/scene_input.h"
#include "client/cli/send_scene.h"
#include "client/cli/shared_options.h"

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
  const auto job_id = co_await send_scene(session, scene, keep_factors, report);
  if (!job_id) co_return job_id.error();
  const JobHandle job{*job_id, server_digits(session.welcome())};
  report.document()["job_id"] = job.number;
  report.document()["handle"] = to_text(job);
  report.line(to_text(job));
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
  return make_command<SubmitOptions>("submit", "queue a scene; prints the job's handle", declare,
                                     run);
}

}  // namespace metamer::cli
