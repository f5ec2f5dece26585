#include "server/sandbox/system_calls.h"

#include <sched.h>
#include <seccomp.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <cerrno>
#include <initializer_list>
#include <memory>

namespace metamer::sandbox {
namespace {

/// By name: a kernel or a processor that lacks a call has nothing to refuse.
using Names = std::initializer_list<const char*>;

constexpr Names programs = {"execve", "execveat"};
constexpr Names sockets = {"socket", "connect", "bind", "listen", "accept", "accept4"};
/// What Landlock has no rights for, or not those of the kernel of Debian 12; and what it has.
constexpr Names changes_of_files = {"truncate",   "chmod",         "fchmod",
                                    "fchmodat",   "fchmodat2",     "chown",
                                    "fchown",     "lchown",        "fchownat",
                                    "utime",      "utimes",        "futimesat",
                                    "utimensat",  "setxattr",      "lsetxattr",
                                    "fsetxattr",  "removexattr",   "lremovexattr",
                                    "mkdir",      "fremovexattr",  "mkdirat",
                                    "mknod",      "mknodat",       "link",
                                    "linkat",     "symlink",       "symlinkat",
                                    "rename",     "renameat",      "renameat2",
                                    "unlink",     "unlinkat",      "rmdir",
                                    "creat",      "chroot",        "name_to_handle_at",
                                    "setxattrat", "removexattrat", "open_by_handle_at",
                                    "umask",      "flock"};
constexpr Names other_processes = {"ptrace",
                                   "process_vm_readv",
                                   "process_vm_writev",
                                   "process_madvise",
                                   "process_mrelease",
                                   "pidfd_open",
                                   "pidfd_getfd",
                                   "kcmp",
                                   "migrate_pages",
                                   "move_pages",
                                   "setpriority",
                                   "ioprio_set",
                                   "setpgid",
                                   "setsid"};
constexpr Names signals_with_values = {"rt_sigqueueinfo", "rt_tgsigqueueinfo", "pidfd_send_signal"};
constexpr Names shared_with_others = {"shmget",  "shmat",       "semget", "semop",   "semtimedop",
                                      "msgget",  "msgsnd",      "msgrcv", "mq_open", "mq_unlink",
                                      "add_key", "request_key", "keyctl"};
constexpr Names identities = {"setuid",    "setgid",    "setreuid",   "setregid",
                              "setresuid", "setresgid", "setgroups",  "setfsuid",
                              "setfsgid",  "capset",    "personality"};
/// Of the machine, and what has let programs out of other sandboxes: the newest and least tried.
constexpr Names machine = {"mount",
                           "umount2",
                           "pivot_root",
                           "move_mount",
                           "open_tree",
                           "open_tree_attr",
                           "fsopen",
                           "fsconfig",
                           "fsmount",
                           "fspick",
                           "mount_setattr",
                           "unshare",
                           "setns",
                           "bpf",
                           "perf_event_open",
                           "userfaultfd",
                           "io_uring_setup",
                           "io_uring_enter",
                           "io_uring_register",
                           "fanotify_init",
                           "kexec_load",
                           "kexec_file_load",
                           "init_module",
                           "finit_module",
                           "delete_module",
                           "reboot",
                           "swapon",
                           "swapoff",
                           "acct",
                           "quotactl",
                           "quotactl_fd",
                           "iopl",
                           "ioperm",
                           "settimeofday",
                           "clock_settime",
                           "clock_adjtime",
                           "adjtimex",
                           "sethostname",
                           "setdomainname",
                           "syslog",
                           "vhangup",
                           "lookup_dcookie"};

struct Release {
  void operator()(void* filter) const { seccomp_release(filter); }
};
using Filter = std::unique_ptr<void, Release>;

/// A call that the library, the kernel or the processor does not have is refused by itself.
template <typename... Conditions>
int refuse(const Filter& filter, const char* name, std::uint32_t how, Conditions... conditions) {
  const int number = seccomp_syscall_resolve_name(name);
  if (number < 0) return 0;
  const scmp_arg_cmp all[] = {conditions..., scmp_arg_cmp{}};
  return seccomp_rule_add_array(filter.get(), how, number, sizeof...(conditions), all);
}

int refuse_all(const Filter& filter, Names names) {
  int error = 0;
  for (const char* name : names)
    if (const int refused = refuse(filter, name, SCMP_ACT_ERRNO(EPERM)); refused != 0)
      error = refused;
  return error;
}

/// Signals but to itself: abort() needs that. And processes but threads; and limits of its own,
/// which others set: an importer's readers begin with theirs.
int refuse_children(const Filter& filter) {
  const auto no = SCMP_ACT_ERRNO(EPERM);
  const auto self = static_cast<scmp_datum_t>(getpid());
  int error = 0;
  for (const int refused :
       {refuse(filter, "kill", no), refuse(filter, "tkill", no),
        refuse(filter, "tgkill", no, SCMP_A0(SCMP_CMP_NE, self)), refuse(filter, "fork", no),
        refuse(filter, "vfork", no),
        refuse(filter, "clone", no, SCMP_A0(SCMP_CMP_MASKED_EQ, CLONE_THREAD, 0)),
        // Its flags lie in memory, where no filter looks: the C library takes clone then.
        refuse(filter, "clone3", SCMP_ACT_ERRNO(ENOSYS)), refuse(filter, "setrlimit", no),
        refuse(filter, "prlimit64", no, SCMP_A2(SCMP_CMP_NE, 0))})
    if (refused != 0) error = refused;
  return error;
}

}  // namespace

int refuse_system_calls(Children children) {
  const Filter filter(seccomp_init(SCMP_ACT_ALLOW));
  if (!filter) return ENOMEM;
  int error = seccomp_attr_set(filter.get(), SCMP_FLTATR_CTL_TSYNC, 1);
  for (const Names names : {programs, sockets, changes_of_files, other_processes,
                            signals_with_values, shared_with_others, identities, machine})
    if (error == 0) error = refuse_all(filter, names);
  // Another process's limits, even to read.
  if (error == 0)
    error = refuse(filter, "prlimit64", SCMP_ACT_ERRNO(EPERM), SCMP_A0(SCMP_CMP_NE, 0));
  if (error == 0 && children == Children::none) error = refuse_children(filter);
  if (error == 0) error = seccomp_load(filter.get());
  return -error;
}

}  // namespace metamer::sandbox
