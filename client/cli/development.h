#pragma once

#include <string>
#include <vector>

#include "client/cli/options.h"
#include "common/image/image.h"
#include "metamer/v1/plan.pb.h"

namespace metamer::cli {

/// Puts --adapt, --rgb and --linear in the place of what a scene, or a finished job's plan, says.
/// Returns the options that were given. Error: a word that names nothing.
Result<std::vector<std::string>> apply(const DevelopmentOptions& options,
                                       v1::Development& development);

/// What the plan says, ready for write_image.
struct PlannedDeveloping {
  Developing developing;
  std::string unadapted;  ///< Why the adaptation that was asked for can't be done; empty: it can.
};

/// Error: the server planned a space that there can't be.
Result<PlannedDeveloping> planned_developing(const v1::Plan& plan);

}  // namespace metamer::cli
