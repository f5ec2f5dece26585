#pragma once

#include "metamer/v1/session.pb.h"
#include "server/worker/job.h"

namespace metamer::worker {

/// What this worker can do, as clients learn it: models.def as data, and the methods of the schema.
v1::Capabilities capabilities(const WorkerOptions& options);

}  // namespace metamer::worker
