#pragma once

#include <optional>
#include <string>
#include <vector>

#include "client/cli/report.h"
#include "client/cli/shared_options.h"
#include "client/tools/scene/checked_scene.h"
#include "metamer/v1/plan.pb.h"

namespace metamer::cli {

/// Reads the scene, puts the options in place of its settings, and checks it and all that it names.
/// Reports every problem found; nothing then.
std::optional<CheckedScene> load_scene(const std::string& file, const Overrides& overrides,
                                       Report& report);

/// Reports problems that a server found, at their places.
void report_problems(const CheckedScene& scene, const std::vector<Problem>& problems,
                     Report& report);
void report_notice(const CheckedScene& scene, const v1::Notice& notice, Report& report);

}  // namespace metamer::cli
