#pragma once

#include <cstdint>
#include <optional>

#include "metamer/v1/plan.pb.h"

namespace metamer::service {

/// Adds what an attempt came to, as its worker says, to what is known of the job: times of each
/// phase, rays of each kind, what each machine drew. `tiles`: that the attempt's machine drew and
/// the picture has. A record beyond what a worker has to say is cut.
void add_run(v1::RunRecord part, std::uint32_t tiles, v1::RunRecord& sum);

/// The tiles are of no use: what was drawn is forgotten, the time that it took is not.
void forget_tiles(v1::RunRecord& sum);

/// Makes the machines' tiles those of the picture: what a daemon drew that was killed before it
/// could say so is of no known machine; what the disk had lost, and came twice, counts once.
void balance_tiles(std::uint32_t tiles, v1::RunRecord& sum);

}  // namespace metamer::service
