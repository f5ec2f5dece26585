#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

/// Landlock, the kernel's rules that a process makes for itself (Linux 5.13; landlock(7)). Its
/// constants stand here as far as Debian 12's headers, which are of Linux 6.1, do not have them.
namespace metamer::sandbox {

/// The version of its interface that the kernel has; 0: none, and errno says why.
int landlock_version();

/// Rights over files, as the kernel numbers them.
namespace right {
inline constexpr std::uint64_t execute = 1 << 0, write_file = 1 << 1, read_file = 1 << 2,
                               read_folder = 1 << 3, use_device = 1 << 15;
}  // namespace right

/// A folder or file, and what may be done with it and what lies below.
struct PathRule {
  std::filesystem::path path;
  std::uint64_t rights = 0;
};

/// From now on this thread, and those that it starts, do with files what `rules` say and nothing
/// else, make no TCP connections, and signal no process that is not confined with them, each as far
/// as the kernel knows it. False, with errno, where nothing is changed.
bool confine_by_landlock(const std::vector<PathRule>& rules);

}  // namespace metamer::sandbox
