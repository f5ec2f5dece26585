#include "client/cli/administration.h"
#include "client/cli/commands.h"
#include "client/cli/connection.h"
#include "client/cli/shared_options.h"

namespace metamer::cli {
namespace {

struct StatsOptions {
  CommonOptions common;
};

boost::asio::awaitable<ExitCode> ask_stats(Session& session, Report& report) {
  const Answer<v1::Info> info = co_await session.info();
  if (!info) co_return report.session_error(info.error());
  Json& document = report.document();
  const Json all = to_json(*info);
  for (const char* part : {"metric", "user", "session"})
    document[part] = all.contains(part) ? all[part] : Json::array();
  print_metrics(*info, report);
  print_users(*info, report);
  print_sessions(*info, report);
  if (info->metric().empty())
    report.note({.field = {}, .file = {}, .message = "what is counted is for admins"});
  co_return ExitCode::done;
}

ExitCode run(const StatsOptions& options) {
  Report report(options.common.json);
  return report.finish(with_server(options.common, report,
                                   [&](Session& session) { return ask_stats(session, report); }));
}

void declare(StatsOptions& values, Options& options) { declare_common(values.common, options); }

}  // namespace

Command commands::stats() {
  return make_command<StatsOptions>(
      "stats", "what a server has counted, its users and its sessions", declare, run);
}

}  // namespace metamer::cli
