#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

#include "common/problem.h"

namespace metamer {

/// "png" or "exr" by the extension, in any case; empty for another.
std::string format_of(const std::filesystem::path& file);

/// `message` about a whole file.
tl::unexpected<Problem> file_problem(const std::filesystem::path& file, std::string message);

/// What a library said, fit for one line of a message.
std::string first_line(const std::string& text);

/// Whether there is something to be read; the error says why not.
Result<void> check_readable(const std::filesystem::path& file);

/// Whether a picture that is to be read has pixels, and no more than max_image_values values.
Result<void> check_size(const std::filesystem::path& file, int width, int height,
                        std::size_t channels);

}  // namespace metamer
