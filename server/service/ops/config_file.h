#pragma once

#include <string>
#include <tl/expected.hpp>
#include <vector>

#include "common/problem.h"
#include "server/service/ops/options.h"

namespace metamer::service {

/// All that is wrong with a file, each with its line and column.
using Problems = std::vector<Problem>;

/// Where the file is unless it is named.
inline constexpr const char* default_config_file = "/etc/metamer/metamerd.toml";

/// Gives `settings` what a text in TOML says, which stands in `file`. Keys that no option has,
/// values that it may not have and what is no TOML are problems; then `settings` has only a part.
tl::expected<void, Problems> read_config(const std::string& text, const std::string& file,
                                         Settings& settings);

/// The same from a file. Errors, besides: it can't be read, it is over 1 MiB.
tl::expected<void, Problems> read_config_file(const std::string& file, Settings& settings);

/// The whole file, each value after a comment that says what it is and what it may be. One that is
/// not set stands in a comment. read_config gives the same settings again.
std::string config_text(const Settings& settings);

}  // namespace metamer::service
