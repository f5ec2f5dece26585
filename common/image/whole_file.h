#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <vector>

#include "common/problem.h"

namespace metamer {

/// Writes beside `file`, then renames: nobody ever sees half of it, and a failure leaves an older
/// file as it was. Errors do not name the file yet.
Result<void> write_whole_file(const std::filesystem::path& file,
                              std::span<const std::span<const std::byte>> pieces);
Result<void> write_whole_file(const std::filesystem::path& file,
                              const std::vector<unsigned char>& bytes);

}  // namespace metamer
