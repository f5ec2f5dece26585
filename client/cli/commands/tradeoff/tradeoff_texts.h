#pragma once

#include <string>
#include <vector>

#include "client/cli/json.h"
#include "client/tools/tradeoff/tradeoff.h"

/// How a trade is shown.
namespace metamer::cli {

/// The rows as people read them, a line each, after a line of headings.
std::vector<std::string> tradeoff_table(const client::Tradeoff& tradeoff);
Json tradeoff_json(const client::Tradeoff& tradeoff);
/// Makes gnuplot draw seconds against ΔE00 on logarithmic axes, with the front and its names.
std::string tradeoff_script(const client::Tradeoff& tradeoff);

}  // namespace metamer::cli
