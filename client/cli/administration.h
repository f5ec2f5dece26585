#pragma once

#include "client/cli/report.h"
#include "metamer/v1/session.pb.h"

namespace metamer::cli {

/// Who is on, a line each, as an admin is told.
void print_sessions(const v1::Info& info, Report& report);
/// What each user has of what all share, a line each.
void print_users(const v1::Info& info, Report& report);
/// What has been counted: name, label, value.
void print_metrics(const v1::Info& info, Report& report);

}  // namespace metamer::cli
