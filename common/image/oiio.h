#pragma once

#include <filesystem>
#include <string>

#include "common/problem.h"

/// What reading and writing share about OpenImageIO; the rest of the project never sees it.
namespace metamer::oiio {

/// Keeps OpenImageIO and OpenEXR in the calling thread: who calls decides how many threads there
/// are. Any thread, any number of times.
void stay_in_this_thread();

/// "png" or "exr" by the extension, in any case; empty for another.
std::string format_of(const std::filesystem::path& file);

/// Rows that are converted at a time, so that no second picture is held.
inline constexpr int rows_at_a_time = 64;

/// `message` about a whole file.
tl::unexpected<Problem> file_problem(const std::filesystem::path& file, std::string message);

/// What a library said, fit for one line of a message.
std::string first_line(const std::string& text);

}  // namespace metamer::oiio
