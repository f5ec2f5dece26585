#include "client/cli/administration.h"

#include <algorithm>

#include "client/tools/text/formatted.h"
#include "client/tools/text/job_text.h"
#include "common/printable.h"

namespace metamer::cli {
namespace {

std::string mebibytes(std::uint64_t bytes) {
  return std::to_string((bytes + (1u << 20) - 1) >> 20) + " MiB";
}

std::string role_text(v1::Role role) {
  switch (role) {
    case v1::VIEWER:
      return "viewer";
    case v1::SUBMITTER:
      return "submitter";
    case v1::ADMIN:
      return "admin";
    case v1::ROLE_UNSPECIFIED:
    case v1::Role_INT_MIN_SENTINEL_DO_NOT_USE_:
    case v1::Role_INT_MAX_SENTINEL_DO_NOT_USE_:
      break;
  }
  return "";
}

}  // namespace

void print_sessions(const v1::Info& info, Report& report) {
  for (const v1::SessionInfo& session : info.session()) {
    const std::string user = session.user().empty() ? "nobody yet" : printable(session.user());
    report.wrapped("session of " + user + " (" + printable(session.peer()) + "): " +
                   printable(session.client()) + ", for " + clock(session.age()) + ", idle " +
                   clock(session.idle()) + ", " + counted(session.watches(), "watch", "watches") +
                   ", " + counted(session.views(), "view", "views"));
  }
}

void print_users(const v1::Info& info, Report& report) {
  for (const v1::UserUsage& user : info.user()) {
    const std::string role = role_text(user.role());
    report.wrapped(
        "user " + printable(user.user()) + (role.empty() ? "" : ", " + role) + ": " +
        counted(user.sessions(), "session", "sessions") +
        "; jobs: " + std::to_string(user.jobs_running()) + " running, " +
        std::to_string(user.jobs_queued()) + " queued, " + std::to_string(user.jobs_ended()) +
        " ended; " + mebibytes(user.asset_bytes()) + " of assets, " +
        mebibytes(user.picture_bytes()) + " of pictures; " +
        client::formatted("%.1f s of workers, share %g", user.worker_seconds(), user.share()) +
        client::formatted("; within a day %.1f s", user.day_seconds()) +
        (user.max_day_seconds() > 0 ? client::formatted(" of %g", user.max_day_seconds()) : ""));
  }
}

void print_metrics(const v1::Info& info, Report& report) {
  const auto name = [](const v1::Metric& metric) {
    return printable(metric.name()) +
           (metric.label().empty() ? "" : "{" + printable(metric.label()) + "}");
  };
  std::size_t width = 0;
  for (const v1::Metric& metric : info.metric()) width = std::max(width, name(metric).size());
  for (const v1::Metric& metric : info.metric()) {
    std::string line = name(metric);
    line.resize(width + 2, ' ');
    report.line(line + client::formatted("%.15g", metric.value()));
  }
}

}  // namespace metamer::cli
