#pragma once

#include <filesystem>
#include <string>

namespace metamer::worker {

/// Confines this process before it parses anything: it can read the store and nothing else, write
/// nothing but its two descriptors, gain no privileges, leave no core, and dies with the daemon.
/// Returns what confines it: "landlock", or "rlimits only: " and why.
std::string enter_sandbox(const std::filesystem::path& store);

}  // namespace metamer::worker
