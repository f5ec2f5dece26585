#pragma once

#include <vector>

#include "client/cli/exit_code.h"
#include "client/cli/report.h"
#include "client/cli/shared_options.h"
#include "client/tools/pictures/save_pictures.h"

namespace metamer::cli {

/// What --exr says: "rgb", "xyz", "spectral" or "spectral:FROM:TO:STEP".
Result<client::ExrContent> exr_content(const OutputOptions& options);

/// Writes the picture into each of the files, and notes what a .png had to clip. Reports what went
/// wrong.
ExitCode write_pictures(const OutputOptions& options, const client::Pictures& pictures,
                        Report& report);

/// The same of several pictures, each into files of its own, on all threads; they are reported in
/// order. `options` have no say in the files' names.
ExitCode write_pictures(const OutputOptions& options, std::vector<client::PictureFiles> all,
                        Report& report);

}  // namespace metamer::cli
