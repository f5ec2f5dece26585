#include "server/sandbox/landlock.h"

#include <fcntl.h>
#include <linux/landlock.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>

namespace metamer::sandbox {
namespace {

/// struct landlock_ruleset_attr of version 6.
struct RulesetAttributes {
  std::uint64_t file_rights = 0, network_rights = 0, scoped = 0;
};

/// What each version of the interface brought: how many rights over files there are, whether it
/// knows those over TCP, and scopes (of abstract sockets and signals).
RulesetAttributes all_of(int version) {
  const int file_rights = version < 2 ? 13 : version < 3 ? 14 : version < 5 ? 15 : 16;
  return {.file_rights = (std::uint64_t{1} << file_rights) - 1,
          .network_rights = version < 4 ? 0u : 3u,
          .scoped = version < 6 ? 0u : 3u};
}

/// An older kernel takes a longer structure as long as what it does not know is 0. glibc has no
/// wrappers.
int create_ruleset(const RulesetAttributes& attributes) {
  return static_cast<int>(syscall(SYS_landlock_create_ruleset, &attributes, sizeof attributes, 0));
}

bool add_rule(int ruleset, const PathRule& rule, std::uint64_t known) {
  landlock_path_beneath_attr beneath{};
  beneath.allowed_access = rule.rights & known;
  beneath.parent_fd = open(rule.path.c_str(), O_PATH | O_CLOEXEC);
  const bool added =
      beneath.parent_fd >= 0 &&
      syscall(SYS_landlock_add_rule, ruleset, LANDLOCK_RULE_PATH_BENEATH, &beneath, 0) == 0;
  const int error = errno;
  if (beneath.parent_fd >= 0) close(beneath.parent_fd);
  errno = error;
  return added;
}

}  // namespace

int landlock_version() {
  const long version =
      syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION);
  return version < 0 ? 0 : static_cast<int>(version);
}

bool confine_by_landlock(const std::vector<PathRule>& rules) {
  const int version = landlock_version();
  if (version == 0) return false;
  const RulesetAttributes attributes = all_of(version);
  const int ruleset = create_ruleset(attributes);
  if (ruleset < 0) return false;
  bool confined = true;
  for (const PathRule& rule : rules)
    confined = confined && add_rule(ruleset, rule, attributes.file_rights);
  confined = confined && syscall(SYS_landlock_restrict_self, ruleset, 0) == 0;
  const int error = errno;
  close(ruleset);
  errno = error;
  return confined;
}

}  // namespace metamer::sandbox
