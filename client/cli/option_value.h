#pragma once

#include <string>

#include "client/cli/command.h"
#include "common/problem.h"

namespace metamer::cli {

/// Gives an option a value that is not a word of the command line; a list gets one more, a flag
/// takes on and off. Errors: it can't have the value.
Result<void> set_value(const Option& option, const std::string& text);

}  // namespace metamer::cli
