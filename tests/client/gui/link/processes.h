#pragma once

#include <signal.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <set>
#include <string>

namespace metamer::gui {

/// The processes that `parent` has started, by the name of their program.
inline std::set<pid_t> children_named(pid_t parent, const std::string& name) {
  std::set<pid_t> found;
  std::error_code gone;
  const std::string tasks = "/proc/" + std::to_string(parent) + "/task";
  // A child is listed under the thread that started it.
  for (const auto& thread : std::filesystem::directory_iterator(tasks, gone)) {
    std::ifstream list(thread.path() / "children");
    for (pid_t child = 0; list >> child;) {
      std::ifstream file("/proc/" + std::to_string(child) + "/comm");
      std::string comm;
      if (std::getline(file, comm) && comm == name) found.insert(child);
    }
  }
  return found;
}

/// Kills them, and says how many there were.
inline std::size_t kill_children(pid_t parent, const std::string& name) {
  const std::set<pid_t> found = children_named(parent, name);
  for (const pid_t child : found) kill(child, SIGKILL);
  return found.size();
}

}  // namespace metamer::gui
