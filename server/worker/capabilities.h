#pragma once

#include <string>
#include <utility>
#include <vector>

#include "metamer/v1/session.pb.h"
#include "server/worker/job.h"

namespace metamer::worker {

/// What this worker can do, as clients learn it: models.def as data, and the methods of the schema.
/// `backends` are those of this build, whatever this worker draws by.
v1::Capabilities capabilities(const WorkerOptions& options,
                              const std::vector<std::pair<std::string, Features>>& backends);

}  // namespace metamer::worker
