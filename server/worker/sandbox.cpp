#include "server/worker/sandbox.h"

#include <fcntl.h>
#include <linux/landlock.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>

#include "common/utf8.h"

namespace metamer::worker {
namespace {

/// Every right over files that Landlock's first version knows (Linux 5.13).
constexpr __u64 all_file_rights =
    LANDLOCK_ACCESS_FS_EXECUTE | LANDLOCK_ACCESS_FS_WRITE_FILE | LANDLOCK_ACCESS_FS_READ_FILE |
    LANDLOCK_ACCESS_FS_READ_DIR | LANDLOCK_ACCESS_FS_REMOVE_DIR | LANDLOCK_ACCESS_FS_REMOVE_FILE |
    LANDLOCK_ACCESS_FS_MAKE_CHAR | LANDLOCK_ACCESS_FS_MAKE_DIR | LANDLOCK_ACCESS_FS_MAKE_REG |
    LANDLOCK_ACCESS_FS_MAKE_SOCK | LANDLOCK_ACCESS_FS_MAKE_FIFO | LANDLOCK_ACCESS_FS_MAKE_BLOCK |
    LANDLOCK_ACCESS_FS_MAKE_SYM;

/// Lets this process read below `folder` and touch no other file. glibc has no wrappers.
bool confine_files(const std::filesystem::path& folder) {
  landlock_ruleset_attr attributes{};
  attributes.handled_access_fs = all_file_rights;
  const long ruleset = syscall(SYS_landlock_create_ruleset, &attributes, sizeof attributes, 0);
  if (ruleset < 0) return false;
  landlock_path_beneath_attr beneath{};
  beneath.allowed_access = LANDLOCK_ACCESS_FS_READ_FILE;
  beneath.parent_fd = open(folder.c_str(), O_PATH | O_CLOEXEC);
  const bool confined =
      beneath.parent_fd >= 0 &&
      syscall(SYS_landlock_add_rule, ruleset, LANDLOCK_RULE_PATH_BENEATH, &beneath, 0) == 0 &&
      syscall(SYS_landlock_restrict_self, ruleset, 0) == 0;
  const int error = errno;
  if (beneath.parent_fd >= 0) close(beneath.parent_fd);
  close(static_cast<int>(ruleset));
  errno = error;
  return confined;
}

}  // namespace

std::string enter_sandbox(const std::filesystem::path& store) {
  load_encodings();
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0);
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  if (confine_files(store)) return "landlock";
  return std::string("rlimits only: landlock: ") + std::strerror(errno);
}

}  // namespace metamer::worker
