#pragma once

#include <filesystem>
#include <string>

#include "common/problem.h"

namespace metamer {

/// "png" or "exr" by the extension, in any case; empty for another.
std::string format_of(const std::filesystem::path& file);

/// `message` about a whole file.
tl::unexpected<Problem> file_problem(const std::filesystem::path& file, std::string message);

}  // namespace metamer
