#pragma once

#include <string>
#include <vector>

#include "client/cli/shared_options.h"
#include "client/tools/pictures/planned_developing.h"

namespace metamer::cli {

/// Puts --adapt, --rgb, --exposure and --linear in the place of what a scene, or a finished job's
/// plan, says. Returns the options that were given. Error: a word that names nothing.
Result<std::vector<std::string>> apply(const DevelopmentOptions& options,
                                       v1::Development& development);

}  // namespace metamer::cli
