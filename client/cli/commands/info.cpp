#include <array>
#include <cstdio>

#include "client/cli/commands.h"
#include "client/cli/connection.h"
#include "client/cli/shared_options.h"
#include "client/tools/text/job_text.h"

namespace metamer::cli {
namespace {

struct InfoOptions {
  CommonOptions common;
};

std::string list(const google::protobuf::RepeatedPtrField<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

void print_gl(const v1::GlCapabilities& gl, Report& report) {
  report.line("gl: " + gl.renderer() + (gl.software() ? ", software" : "") + "; GL " +
              gl.version());
  report.line("  buffers of " + std::to_string(gl.storage_bytes() >> 20) + " MiB, textures of " +
              std::to_string(gl.texture_side()) + " pixels");
  report.line(gl.loop_iterations()
                  ? "  leaves loops after " + std::to_string(gl.loop_iterations()) + " iterations"
                  : std::string("  runs loops to their end"));
  report.line(gl.timers() ? "  its timers agree with the clock"
                          : "  its timers disagree with the clock and are not used");
}

void print_info(const v1::Info& info, double ping, Report& report) {
  std::array<char, 160> text{};
  std::snprintf(text.data(), text.size(), "up %s, answers in %.1f ms, %u %s",
                clock(info.uptime()).c_str(), ping * 1e3, info.sessions(),
                info.sessions() == 1 ? "session" : "sessions");
  report.line(info.server() + ": " + text.data());
  report.line("jobs: " + std::to_string(info.jobs_running()) + " running, " +
              std::to_string(info.jobs_queued()) + " queued; " +
              std::to_string((info.store_bytes() + (1u << 20) - 1) >> 20) + " MiB of assets");
  for (const v1::WorkerInfo& worker : info.worker())
    report.line(worker.backend() + " worker" +
                (worker.pid() ? " " + std::to_string(worker.pid()) : "") + ": " + worker.state() +
                ", start " + std::to_string(worker.starts()) +
                (worker.sandbox().empty() ? "" : ", sandbox " + worker.sandbox()) +
                (worker.last_exit().empty() ? "" : "; the one before: " + worker.last_exit()));
  report.line("backends: " + list(info.capabilities().backend()) + " (" +
              std::to_string(info.capabilities().threads()) + " threads)");
  if (info.capabilities().has_gl()) print_gl(info.capabilities().gl(), report);
  report.line("methods: " + list(info.capabilities().method()));
  for (const v1::ModelInfo& model : info.capabilities().model()) {
    report.line(model.kind() + " " + model.name() + ": " + model.citation());
    for (const v1::ParameterInfo& parameter : model.parameter()) {
      std::snprintf(text.data(), text.size(), " = %g, %g to %g", parameter.default_value(),
                    parameter.min(), parameter.max());
      report.line("  " + parameter.name() + text.data() +
                  (parameter.unit().empty() ? "" : " " + parameter.unit()) + ": " +
                  parameter.meaning());
    }
  }
}

boost::asio::awaitable<ExitCode> ask_info(Session& session, Report& report) {
  const Answer<double> ping = co_await session.ping();
  if (!ping) co_return report.session_error(ping.error());
  const Answer<v1::Info> info = co_await session.info();
  if (!info) co_return report.session_error(info.error());
  report.document()["ping_seconds"] = *ping;
  report.document()["info"] = to_json(*info);
  print_info(*info, *ping, report);
  co_return ExitCode::done;
}

ExitCode run(const InfoOptions& options) {
  Report report(options.common.json);
  return report.finish(with_server(options.common, report,
                                   [&](Session& session) { return ask_info(session, report); }));
}

void declare(InfoOptions& values, Options& options) { declare_common(values.common, options); }

}  // namespace

Command commands::info() {
  return make_command<InfoOptions>("info", "what a server can do and how it is", declare, run);
}

}  // namespace metamer::cli
