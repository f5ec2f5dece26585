#pragma once

namespace metamer::worker {

/// From now on the process ends with wire::exit_out_of_memory where the system refuses it memory,
/// whichever thread and library asked for it: half a step can't be taken back, and to say why takes
/// memory. After the importer is forked, whose readers say it themselves.
void end_when_out_of_memory();

}  // namespace metamer::worker
