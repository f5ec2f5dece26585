#include "server/sandbox/sandbox.h"

#include <sys/prctl.h>
#include <sys/resource.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <set>
#include <system_error>

#include "common/utf8.h"
#include "server/sandbox/landlock.h"
#include "server/sandbox/system_calls.h"

namespace metamer::sandbox {
namespace {

void add(std::string& list, const std::string& item) { list += (list.empty() ? "" : ", ") + item; }

}  // namespace

std::string describe(const Confinement& confinement) {
  if (confinement.lacks.empty()) return confinement.kinds;
  return (confinement.kinds.empty() ? "none; " : confinement.kinds + " only; ") + confinement.lacks;
}

std::vector<std::filesystem::path> open_devices(int last_given) {
  std::set<std::filesystem::path> devices;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd", error)) {
    if (std::atoi(entry.path().filename().c_str()) <= last_given) continue;
    const auto path = std::filesystem::read_symlink(entry, error);
    if (!error && std::filesystem::is_character_file(path, error)) devices.insert(path);
  }
  return {devices.begin(), devices.end()};
}

void confine_driver() {
  prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  confine_by_landlock({{"/", right::execute | right::read_file | right::read_folder},
                       {"/dev", right::write_file | right::use_device}});
}

Confinement enter(const std::filesystem::path& store,
                  const std::vector<std::filesystem::path>& devices, Children children) {
  load_encodings();
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);

  Confinement confinement;
  std::vector<PathRule> rules = {{store, right::read_file}};
  for (const auto& device : devices)
    rules.push_back({device, right::read_file | right::write_file | right::use_device});
  if (confine_by_landlock(rules))
    add(confinement.kinds, "landlock " + std::to_string(landlock_version()));
  else
    add(confinement.lacks, std::string("landlock: ") + std::strerror(errno));
  if (const int error = refuse_system_calls(children); error == 0)
    add(confinement.kinds, "seccomp");
  else
    add(confinement.lacks, std::string("seccomp: ") + std::strerror(error));
  return confinement;
}

}  // namespace metamer::sandbox
