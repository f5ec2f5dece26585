#pragma once

#include "client/cli/json.h"
#include "common/color/error_statistics.h"

namespace metamer::cli {

/// Of a picture so many pixels wide: its places become {"x", "y"}.
Json statistics_json(const ErrorStatistics& statistics, int width);

}  // namespace metamer::cli
