#pragma once

#include <optional>
#include <string>

#include "client/cli/report.h"

namespace metamer::cli {

/// Says what a file is that says that it is a bispectral matrix (is_bispectral): its ranges, its
/// values, and how much of light it sends out again at most. Nothing: it is no such file. False: it
/// is one with an error, which is reported.
std::optional<bool> tell_bispectral(const std::string& file, Report& report);

}  // namespace metamer::cli
