#include "server/service/executors/control_group.h"

#include <sys/xattr.h>

#include <algorithm>
#include <fstream>
#include <sstream>

namespace metamer::service {

namespace {

namespace fs = std::filesystem;

/// Each write to such a file is a command, which the kernel takes or refuses.
bool write_command(const fs::path& file, const std::string& text) {
  std::ofstream out(file);
  out << text;
  out.flush();
  return out.good();
}

bool lists_memory(const fs::path& file) {
  std::ifstream in(file);
  for (std::string word; in >> word;)
    if (word == "memory") return true;
  return false;
}

}  // namespace

Result<fs::path> delegated_control_group() {
  std::ifstream own("/proc/self/cgroup");
  for (std::string line; std::getline(own, line);) {
    if (!line.starts_with("0::/")) continue;
    const fs::path group = "/sys/fs/cgroup" + line.substr(3);
    // What is not delegated is systemd's, whatever a root may write.
    char yes = 0;
    if (::getxattr(group.c_str(), "user.delegate", &yes, 1) != 1 || yes != '1')
      return problem("no control group is delegated");
    if (!lists_memory(group / "cgroup.controllers"))
      return problem("the control group that is delegated has no memory");
    return group;
  }
  return problem("there are no control groups of version 2");
}

Result<void> divide_control_group(const fs::path& group) {
  std::error_code error;
  fs::create_directory(group / "daemon", error);
  if (error || !write_command(group / "daemon" / "cgroup.procs", "0"))
    return problem("can't move into " + (group / "daemon").string());
  if (!write_command(group / "cgroup.subtree_control", "+memory"))
    return problem("can't hand the memory of " + group.string() + " on");
  return {};
}

ControlGroup::ControlGroup(const fs::path& divided, std::string lane) {
  std::replace(lane.begin(), lane.end(), ' ', '-');
  std::error_code error;
  fs::create_directory(divided / lane, error);
  if (!error) path_ = divided / lane;
}

bool ControlGroup::allow(std::uint64_t bytes) const {
  return !path_.empty() && write_command(path_ / "memory.max", std::to_string(bytes));
}

std::uint64_t ControlGroup::ended_for_memory() const {
  std::ifstream in(path_ / "memory.events");
  std::string word;
  for (std::uint64_t count = 0; in >> word >> count;)
    if (word == "oom_kill") return count;
  return 0;
}

}  // namespace metamer::service
