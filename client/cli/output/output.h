#pragma once

#include <string>

#include "client/cli/exit_code.h"
#include "client/cli/follow.h"
#include "client/cli/report.h"
#include "client/cli/shared_options.h"

namespace metamer::cli {

/// Whether the files named can be written at the end, before anything is rendered: known
/// extensions, no name twice, folders that exist, and what writes them. Prints what is wrong.
ExitCode check_output(const OutputOptions& options, Report& report);

/// What of a job has to be asked for.
JobParts wanted(const OutputOptions& options);

/// Writes a finished job's picture into each of the files, with the plan, the timing, the scene's
/// name and the version as metadata, and notes what a .png had to clip; and its factors.
ExitCode write_output(const OutputOptions& options, JobRecord& job, const std::string& name,
                      Report& report);

}  // namespace metamer::cli
