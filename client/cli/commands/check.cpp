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
  bool prepare = false;
};

/// "looks: D65, shop".
void report_looks(const v1::Scene& scene, Report& report) {
  if (scene.look().empty()) return;
  std::string names;
  Json& looks = report.document()["looks"] = Json::array();
  for (const v1::Look& look : scene.look()) {
    names += (names.empty() ? "" : ", ") + look.name();
    looks.push_back(look.name());
  }
  report.line("looks: " + names);
}

/// Lets the server compile and plan: it alone reads meshes and knows the models' parameters.
boost::asio::awaitable<ExitCode> check_on(Session& session, const CheckedScene& scene, bool prepare,
                                          Report& report) {
  Submission submission = make_submission(scene.scene(), scene.assets(), scene.name(), true);
  submission.request.set_prepare(prepare);
  const Answer<std::uint64_t> job_id = co_await session.submit(submission);
  if (!job_id) co_return report.session_error(job_id.error());

  const Answer<JobRecord> job = co_await follow(session, *job_id, JobParts::plan);
  if (!job) co_return report.session_error(job.error());

  const ExitCode code = conclude(*job, &scene, report);
  if (code == ExitCode::done && job->plan) {
    report.line("good: " + describe(*job->plan));
    report_looks(scene.scene(), report);
  }
  if (code == ExitCode::done && job->prepared)
    report.line("prepared: " + prepared_text(*job->prepared));
  else if (code == ExitCode::done && prepare)
    report.note({.field = {}, .file = {}, .message = "this server does not know --prepare"});
  co_return code;
}

ExitCode run(const CheckOptions& options) {
  Report report(options.common.json);
  const auto scene = load_scene(options.scene, options.overrides, report);
  if (!scene) return report.finish(ExitCode::bad_input);
  return report.finish(with_any_server(options.common, report, [&](Session& session, Interrupts&) {
    return check_on(session, *scene, options.prepare, report);
  }));
}

void declare(CheckOptions& values, Options& options) {
  declare_scene(values.scene, options);
  declare_overrides(values.overrides, options);
  options.push_back({.names = "--prepare",
                     .target = &values.prepare,
                     .meaning = "make hierarchy and tables, too, and say what each took"});
  declare_common(values.common, options);
}

}  // namespace

Command commands::check() {
  return make_command<CheckOptions>(
      "check", "say what is wrong with a scene, or what would be rendered", declare, run);
}

}  // namespace metamer::cli
