#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <system_error>

#include "common/problem.h"

namespace metamer::service {

/// Makes a folder that is not there. Errors: it can't be made, or is there and can't be written, as
/// on a disk that is mounted read-only. `what`: "the state's folder".
Result<void> make_folder(const std::filesystem::path& folder, const std::string& what);

/// A sync has failed: nobody knows which of the bytes are there, and another would say that all
/// are.
struct SyncError : std::system_error {
  using std::system_error::system_error;
};

// What was written is on the disk when these return. They throw SyncError, std::system_error.

/// A file's bytes, and its name in its folder.
void sync_file(const std::filesystem::path& file);
/// The names in a folder.
void sync_folder(const std::filesystem::path& folder);
/// A file of so many zeros.
void write_zeros(const std::filesystem::path& file, std::uint64_t bytes);
/// Finds out whether so many bytes, 4 MiB at most, could be written there: makes that file, and
/// removes it.
void try_to_write(const std::filesystem::path& file, std::uint64_t bytes);

}  // namespace metamer::service
