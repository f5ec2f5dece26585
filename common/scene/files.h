#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "common/digest.h"
#include "common/problem.h"

namespace metamer {

/// "(20000000 bytes; at most 16777216)".
std::string size_and_limit(std::uint64_t size, std::uint64_t limit);

/// The bytes of a regular file of at most `limit` bytes. Errors name the file as given.
Result<std::string> read_file(const std::filesystem::path& file, std::uint64_t limit);

/// The file `name` in `folder`: what it is, once all doubt is out of the way. Errors, as sentences
/// about `name`: it is absolute or leads out of the folder (also by ".." or a symbolic link), does
/// not exist (with "did you mean" if `guess`, which lists a folder), is a folder or another thing
/// that is no file, has more than `limit` bytes.
Result<std::filesystem::path> find_in_folder(const std::string& name,
                                             const std::filesystem::path& folder,
                                             std::uint64_t limit, bool guess);

/// A file that its path alone names. Errors, as sentences about it: those of find_in_folder that
/// are not of the folder.
Result<std::filesystem::path> find_file(const std::filesystem::path& path, std::uint64_t limit);

/// Size and SHA-256 of a file, read in pieces.
struct FileDigest {
  std::uint64_t size = 0;
  Digest sha256{};
};
Result<FileDigest> digest_file(const std::filesystem::path& file, std::uint64_t limit);

}  // namespace metamer
