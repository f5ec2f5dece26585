#pragma once

#include <filesystem>
#include <istream>

#include "common/problem.h"

namespace metamer {

/// Whether the attributes in the headers of an .exr lie within the file and have the sizes of their
/// types (openexr.com, "OpenEXR File Layout"). OpenEXR 3.1 takes as much memory as an attribute
/// claims before it reads it, 2 GiB for a file of a kilobyte, and lets those of a fixed size claim
/// another. All else about them is for OpenEXR to check. The error names the file.
Result<void> check_exr_header(std::istream& in, const std::filesystem::path& name);

}  // namespace metamer
