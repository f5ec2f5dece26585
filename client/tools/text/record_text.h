#pragma once

#include <string>
#include <vector>

#include "metamer/v1/plan.pb.h"

namespace metamer::client {

/// A job's record as people read it, a line a fact: builds, machines, phases, what was warm, rays.
std::vector<std::string> record_lines(const v1::RunRecord& record);

}  // namespace metamer::client
