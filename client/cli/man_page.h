#pragma once

#include <string>

namespace metamer::cli {

/// metamer(1) as roff, from the subcommands and their options.
std::string man_page();

}  // namespace metamer::cli
