#pragma once

#include <string>
#include <vector>

#include "client/cli/json.h"
#include "client/tools/series/sweep.h"

/// How a sweep is shown.
namespace metamer::cli {

/// The rows as people read them, a line each, after a line of headings and before what their
/// differences mean.
std::vector<std::string> sweep_table(const std::vector<client::SweepOutcome>& outcomes);
Json sweep_json(const std::vector<client::SweepAxis>& axes,
                const std::vector<client::SweepOutcome>& outcomes);
/// Below a row's picture on a sheet.
std::string sweep_note(const client::SweepOutcome& outcome);

}  // namespace metamer::cli
