#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "common/problem.h"

namespace metamer {

/// Where a picture is: a file on disk, or the bytes of one, which stay where they are meanwhile.
struct PictureSource {
  PictureSource(std::filesystem::path file) : name(std::move(file)) {}
  PictureSource(std::string_view of, std::filesystem::path called)
      : name(std::move(called)), bytes(of) {}

  std::filesystem::path name;  ///< Of the file; of bytes for messages alone.
  std::optional<std::string_view> bytes;
};

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
