#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "client/cli/administration.h"
#include "client/cli/commands.h"
#include "client/cli/connection.h"
#include "client/cli/shared_options.h"
#include "client/tools/text/formatted.h"
#include "client/tools/text/job_text.h"

namespace metamer::cli {
namespace {

struct InfoOptions {
  CommonOptions common;
  bool models = false;   ///< Each with its citation and its parameters.
  bool methods = false;  ///< What each backend and each method has.
  bool all = false;
  bool health = false;  ///< Nothing but whether the server is well.
};

std::string list(const google::protobuf::RepeatedPtrField<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

void print_gl(const v1::GlCapabilities& gl, Report& report) {
  report.wrapped("gl: " + gl.renderer() + (gl.software() ? ", software" : "") + "; GL " +
                 gl.version());
  report.wrapped("  buffers of " + std::to_string(gl.storage_bytes() >> 20) + " MiB, textures of " +
                 std::to_string(gl.texture_side()) + " pixels, " +
                 (gl.loop_iterations() ? "leaves loops after " +
                                             std::to_string(gl.loop_iterations()) + " iterations, "
                                       : std::string()) +
                 (gl.timers() ? "timers agree with the clock"
                              : "timers disagree with the clock and are not used"));
}

void print_server(const v1::Info& info, double ping, Report& report) {
  report.wrapped(info.server() + ": up " + clock(info.uptime()) +
                 client::formatted(", answers in %.1f ms, %u %s", ping * 1e3, info.sessions(),
                                   info.sessions() == 1 ? "session" : "sessions"));
  if (!info.trouble().empty()) report.wrapped("trouble: " + info.trouble());
  report.wrapped("jobs: " + std::to_string(info.jobs_running()) + " running, " +
                 std::to_string(info.jobs_queued()) + " queued; " +
                 std::to_string((info.store_bytes() + (1u << 20) - 1) >> 20) + " MiB of assets" +
                 (info.state_bytes() == 0
                      ? std::string()
                      : ", " + std::to_string((info.state_bytes() + (1u << 20) - 1) >> 20) +
                            " MiB of pictures kept"));
  print_users(info, report);
  print_sessions(info, report);
  for (const v1::WorkerInfo& worker : info.worker())
    report.wrapped(
        worker.backend() + " worker" + (worker.pid() ? " " + std::to_string(worker.pid()) : "") +
        ": " + worker.state() + ", start " + std::to_string(worker.starts()) +
        (worker.isa().empty()
             ? ""
             : ", " + worker.isa() + " in packets of " + std::to_string(worker.lanes())) +
        (worker.sandbox().empty() ? "" : ", sandbox " + worker.sandbox()) +
        (worker.last_exit().empty() ? "" : "; the one before: " + worker.last_exit()));
  report.wrapped("backends: " + list(info.capabilities().backend()) + " (" +
                 std::to_string(info.capabilities().threads()) + " threads)");
  if (info.capabilities().has_gl()) print_gl(info.capabilities().gl(), report);
  report.wrapped("methods: " + list(info.capabilities().method()));
}

/// The models by kind, a line each.
void print_model_names(const v1::Capabilities& capabilities, Report& report) {
  std::vector<std::pair<std::string, std::string>> kinds;
  for (const v1::ModelInfo& model : capabilities.model()) {
    auto found = std::find_if(kinds.begin(), kinds.end(),
                              [&](const auto& one) { return one.first == model.kind(); });
    if (found == kinds.end()) found = kinds.insert(found, {model.kind(), ""});
    found->second += (found->second.empty() ? "" : ", ") + model.name();
  }
  for (const auto& [kind, names] : kinds) report.wrapped(kind + ": " + names);
}

void print_models(const v1::Capabilities& capabilities, Report& report) {
  for (const v1::ModelInfo& model : capabilities.model()) {
    report.line(model.kind() + " " + model.name() + ": " + model.citation());
    for (const v1::ParameterInfo& parameter : model.parameter())
      report.line("  " + parameter.name() +
                  client::formatted(" = %g, %g to %g", parameter.default_value(), parameter.min(),
                                    parameter.max()) +
                  (parameter.unit().empty() ? "" : " " + parameter.unit()) + ": " +
                  parameter.meaning());
  }
}

/// What each has of what a scene may need.
void print_features(const char* what,
                    const google::protobuf::RepeatedPtrField<v1::FeatureSet>& sets,
                    Report& report) {
  for (const v1::FeatureSet& set : sets)
    report.wrapped(
        std::string(what) + " " + set.name() + ": " +
        (set.feature().empty() ? "nothing that a scene has to ask for" : list(set.feature())));
}

/// What one may ask for; an older server does not say all of it.
void print_limits(const v1::Limits& limits, Report& report) {
  const auto number = [](std::uint64_t value) { return std::to_string(value); };
  std::string line = "limits: a picture of " + number(limits.pixels()) + " pixels";
  if (limits.view_pixels() > 0) line += ", a view of " + number(limits.view_pixels());
  line += "; files of " + number(limits.asset() >> 20) + " MiB, " +
          number(limits.assets_per_job()) + " a job; " + number(limits.queued_jobs()) +
          " jobs that have not ended";
  if (limits.views() > 0) line += "; " + counted(limits.views(), "view", "views");
  if (limits.watches() > 0)
    line += " and " + counted(limits.watches(), "watch", "watches") + " a session";
  report.wrapped(line);
}

void print_info(const v1::Info& info, double ping, const InfoOptions& options, Report& report) {
  const v1::Capabilities& capabilities = info.capabilities();
  const bool some = options.models || options.methods;
  if (!some) print_server(info, ping, report);
  if (options.all) {
    print_limits(info.limits(), report);
    for (const v1::Choice& choice : capabilities.choice())
      report.wrapped(choice.field() + ": " + list(choice.word()));
  }
  if (options.methods || options.all) {
    print_features("backend", capabilities.backend_features(), report);
    print_features("method", capabilities.method_features(), report);
  }
  if (options.models || options.all) print_models(capabilities, report);
  if (some || options.all) return;
  print_model_names(capabilities, report);
  report.line("more: --models, --methods, --all");
}

/// For scripts and monitors: well is who answers and takes jobs.
ExitCode conclude_health(const v1::Info& info, Report& report) {
  report.document()["healthy"] = info.trouble().empty();
  if (!info.trouble().empty()) {
    report.error(info.trouble());
    return ExitCode::other;
  }
  report.line("healthy");
  return ExitCode::done;
}

boost::asio::awaitable<ExitCode> ask_info(Session& session, const InfoOptions& options,
                                          Report& report) {
  const Answer<double> ping = co_await session.ping();
  if (!ping) co_return report.session_error(ping.error());
  const Answer<v1::Info> info = co_await session.info();
  if (!info) co_return report.session_error(info.error());
  report.document()["ping_seconds"] = *ping;
  report.document()["info"] = to_json(*info);
  if (options.health) co_return conclude_health(*info, report);
  print_info(*info, *ping, options, report);
  co_return ExitCode::done;
}

ExitCode run(const InfoOptions& options) {
  Report report(options.common.json);
  return report.finish(with_server(options.common, report, [&](Session& session) {
    return ask_info(session, options, report);
  }));
}

void declare(InfoOptions& values, Options& options) {
  const auto add = [&](const char* name, bool& target, const char* meaning) {
    options.push_back({.names = name, .target = &target, .meaning = meaning});
  };
  add("--models", values.models, "the models and their parameters, with where they are from");
  add("--methods", values.methods, "what each backend and each method has");
  add("--health", values.health,
      "say no more than whether it is well: exit code 0; 1: it says its trouble");
  add("--all", values.all, "all of that, the limits, and the words of a scene's strings");
  declare_common(values.common, options);
}

}  // namespace

Command commands::info() {
  return make_command<InfoOptions>("info", "what a server can do and how it is", declare, run);
}

}  // namespace metamer::cli
