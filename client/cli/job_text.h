#pragma once

#include <string>

#include "metamer/v1/jobs.pb.h"

namespace metamer::cli {

/// "  7  running   120/300  0:42  booth.txtpb": number, state, tiles, age, name, reason.
std::string describe(const v1::JobSummary& job);

/// "12  3.204 s  progress 120/300 tiles, 1200000 rays": one line, no pixels.
std::string describe(const v1::JobEvent& event);

const char* word(v1::JobState state);

}  // namespace metamer::cli
