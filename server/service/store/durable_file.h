#pragma once

#include <filesystem>

namespace metamer::service {

// What was written is on the disk when these return. They throw std::system_error.

/// A file's bytes, and its name in its folder.
void sync_file(const std::filesystem::path& file);
/// The names in a folder.
void sync_folder(const std::filesystem::path& folder);

}  // namespace metamer::service
