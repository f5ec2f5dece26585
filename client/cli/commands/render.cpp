#include <unistd.h>

#include <boost/asio/this_coro.hpp>
#include <iostream>

#include "client/cli/commands.h"
#include "client/cli/connection.h"
#include "client/cli/follow.h"
#include "client/cli/output/output.h"
#include "client/cli/scene_input.h"
#include "client/cli/send_scene.h"
#include "client/cli/shared_options.h"

namespace metamer::cli {
namespace {

namespace asio = boost::asio;

struct RenderOptions {
  CommonOptions common;
  std::string scene;
  Overrides overrides;
  OutputOptions output;
};

/// Says how to get the picture of a job that goes on without us.
void tell_how_to_continue(const RenderOptions& options, const JobHandle& job, Report& report) {
  report.document()["job_id"] = job.number;
  report.document()["handle"] = to_text(job);
  const std::string server = server_name(options.common);
  if (server.empty()) return;  // a private server takes its jobs along
  std::string command = "metamer fetch " + to_text(job) + " --server " + server;
  for (const std::string& file : options.output.files) command += " -o " + file;
  if (options.output.png != "8") command += " --png " + options.output.png;
  if (options.output.exr != "rgb") command += " --exr " + options.output.exr;
  report.document()["continue"] = command;
  std::cerr << "job " << to_text(job) << " goes on there; to get its picture: " << command << '\n';
}

asio::awaitable<ExitCode> render_on(Session& session, Interrupts& interrupts,
                                    const RenderOptions& options, const CheckedScene& scene,
                                    Report& report) {
  const auto executor = co_await asio::this_coro::executor;
  const bool keep_factors = wanted(options.output) == JobParts::picture_and_factors;
  const auto job_id = co_await send_scene(session, scene, keep_factors, report);
  if (!job_id) co_return job_id.error();

  interrupts.on_first([&session, executor, id = *job_id] {
    // A terminal shows the bar and ^C on this line.
    std::cerr << (isatty(STDERR_FILENO) == 1 ? "\n" : "")
              << "cancelling; press Ctrl-C again to leave at once\n";
    request_cancel(executor, session, id);
  });
  Answer<JobRecord> job = co_await follow(session, *job_id, wanted(options.output));
  interrupts.on_first({});
  if (!job) {
    const ExitCode code = report.session_error(job.error());
    if (job.error().kind == SessionError::Kind::disconnected)
      tell_how_to_continue(options, {*job_id, server_digits(session.welcome())}, report);
    co_return code;
  }

  const ExitCode code = conclude(*job, &scene, report);
  if (code != ExitCode::done && code != ExitCode::promise_broken) co_return code;
  const ExitCode written = write_output(options.output, *job, scene.name(), report);
  co_return written == ExitCode::done ? code : written;
}

ExitCode run(const RenderOptions& options) {
  Report report(options.common.json);
  const ExitCode fit = check_output(options.output, report);
  if (fit != ExitCode::done) return report.finish(fit);
  const auto scene = load_scene(options.scene, options.overrides, report);
  if (!scene) return report.finish(ExitCode::bad_input);
  const ExitCode code =
      with_any_server(options.common, report, [&](Session& session, Interrupts& interrupts) {
        return render_on(session, interrupts, options, *scene, report);
      });
  return report.finish(code);
}

void declare(RenderOptions& values, Options& options) {
  declare_scene(values.scene, options);
  declare_output(values.output, options);
  declare_overrides(values.overrides, options);
  declare_common(values.common, options);
}

}  // namespace

Command commands::render() {
  return make_command<RenderOptions>("render", "render a scene into picture files", declare, run);
}

}  // namespace metamer::cli
