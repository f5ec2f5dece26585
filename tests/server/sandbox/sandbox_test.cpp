#include "server/sandbox/sandbox.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/ptrace.h>
#include <sys/resource.h>
#include <sys/shm.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <sys/xattr.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <functional>
#include <string>
#include <thread>
#include <utility>

namespace metamer::sandbox {
namespace {

namespace fs = std::filesystem;

constexpr int unconfined = 77;

/// How a process ends that `act`s confined so: what it returns, or 128 and its signal. It ends
/// `unconfined` where the system can't confine it.
int ended(const std::function<int()>& act, const fs::path& store,
          const std::vector<fs::path>& devices = {}, Children children = Children::none) {
  const pid_t child = fork();
  if (child == 0) {
    if (!enter(store, devices, children).lacks.empty()) _exit(unconfined);
    _exit(act());
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

bool opens(const fs::path& path, int flags) {
  const int descriptor = open(path.c_str(), flags | O_CLOEXEC, 0600);
  if (descriptor >= 0) close(descriptor);
  return descriptor >= 0;
}

class SandboxTest : public testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "metamer-sandbox-XXXXXX").string();
    ASSERT_NE(mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
    fs::create_directories(folder_ / "store");
    std::ofstream(folder_ / "store/asset") << "bytes";
    std::ofstream(folder_ / "outside") << "bytes";
    if (ended([] { return 0; }, store()) == unconfined)
      GTEST_SKIP() << "this kernel has no Landlock or no seccomp";
  }
  void TearDown() override { fs::remove_all(folder_); }

  fs::path store() const { return folder_ / "store"; }
  /// Whether `act` succeeds in a confined process.
  bool succeeds(const std::function<bool()>& act, Children children = Children::none) const {
    const int end = ended([&] { return act() ? 0 : 1; }, store(), {}, children);
    EXPECT_LE(end, 1) << "it did not end by itself";
    return end == 0;
  }

  fs::path folder_;
};

TEST_F(SandboxTest, LetsComputeAndReadTheStore) {
  EXPECT_TRUE(succeeds([&] { return opens(store() / "asset", O_RDONLY); }));
  EXPECT_TRUE(succeeds([] {
    const int memory = memfd_create("pixels", MFD_CLOEXEC);
    return memory >= 0 && ftruncate(memory, 1 << 20) == 0 &&
           mmap(nullptr, 1 << 20, PROT_READ | PROT_WRITE, MAP_SHARED, memory, 0) != MAP_FAILED;
  }));
  EXPECT_TRUE(succeeds([] {
    std::atomic<int> sum = 0;
    std::thread([&] { sum = 1; }).join();
    return sum == 1;
  }));
  EXPECT_TRUE(succeeds([] {
    int pair[2];
    return socketpair(AF_UNIX, SOCK_STREAM, 0, pair) == 0 && write(pair[0], "x", 1) == 1;
  }));
  EXPECT_EQ(ended([]() -> int { abort(); }, store()), 128 + SIGABRT) << "its end says why";
}

TEST_F(SandboxTest, RefusesFiles) {
  const fs::path asset = store() / "asset", outside = folder_ / "outside";
  const std::pair<const char*, std::function<bool()>> attempts[] = {
      {"read outside", [&] { return opens(outside, O_RDONLY); }},
      {"read /etc/passwd", [&] { return opens("/etc/passwd", O_RDONLY); }},
      {"list the store", [&] { return opens(store(), O_RDONLY | O_DIRECTORY); }},
      {"write", [&] { return opens(asset, O_WRONLY); }},
      {"empty by opening", [&] { return opens(asset, O_RDONLY | O_TRUNC); }},
      {"make", [&] { return opens(store() / "new", O_WRONLY | O_CREAT); }},
      {"make without a name", [&] { return opens(store(), O_WRONLY | O_TMPFILE); }},
      {"truncate", [&] { return truncate(asset.c_str(), 1) == 0; }},
      {"remove", [&] { return unlink(asset.c_str()) == 0; }},
      {"rename", [&] { return rename(asset.c_str(), (store() / "b").c_str()) == 0; }},
      {"link", [&] { return link(asset.c_str(), (store() / "b").c_str()) == 0; }},
      {"symlink", [&] { return symlink("/etc/passwd", (store() / "b").c_str()) == 0; }},
      {"make a folder", [&] { return mkdir((store() / "b").c_str(), 0700) == 0; }},
      {"make a pipe", [&] { return mkfifo((store() / "b").c_str(), 0700) == 0; }},
      {"change the mode", [&] { return chmod(asset.c_str(), 0777) == 0; }},
      {"change the owner", [&] { return chown(asset.c_str(), getuid(), getgid()) == 0; }},
      {"change the time", [&] { return utimensat(AT_FDCWD, asset.c_str(), nullptr, 0) == 0; }},
      {"set an attribute", [&] { return setxattr(asset.c_str(), "user.a", "b", 1, 0) == 0; }},
  };
  for (const auto& [what, attempt] : attempts) EXPECT_FALSE(succeeds(attempt)) << what;
  EXPECT_EQ(fs::file_size(asset), 5u);
}

TEST_F(SandboxTest, RefusesTheNetwork) {
  // A daemon's own socket, whose file the user may use.
  sockaddr_un address{.sun_family = AF_UNIX, .sun_path = {}};
  const std::string path = folder_ / "socket";
  path.copy(address.sun_path, sizeof address.sun_path - 1);
  const int daemon = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  const auto* at = reinterpret_cast<const sockaddr*>(&address);
  ASSERT_EQ(bind(daemon, at, sizeof address), 0);
  ASSERT_EQ(listen(daemon, 1), 0);
  const int made_before = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  EXPECT_FALSE(succeeds([&] { return connect(made_before, at, sizeof address) == 0; }));
  EXPECT_FALSE(succeeds([&] { return accept(daemon, nullptr, nullptr) >= 0; }));
  for (const int family : {AF_UNIX, AF_INET, AF_INET6, AF_NETLINK, AF_PACKET})
    EXPECT_FALSE(succeeds([&] { return socket(family, SOCK_STREAM, 0) >= 0; })) << family;
  EXPECT_EQ(connect(made_before, at, sizeof address), 0) << "it was to be had";
  close(made_before);
  close(daemon);
}

TEST_F(SandboxTest, RefusesOtherProcesses) {
  const pid_t test = getpid();
  char byte = 0;
  const std::pair<const char*, std::function<bool()>> attempts[] = {
      {"signal its parent", [&] { return kill(test, 0) == 0; }},
      {"signal all", [&] { return kill(-1, 0) == 0; }},
      {"signal a thread", [&] { return syscall(SYS_tgkill, test, test, 0) == 0; }},
      {"signal by descriptor", [&] { return syscall(SYS_pidfd_open, test, 0) >= 0; }},
      {"signal with a value", [&] { return sigqueue(test, 0, {}) == 0; }},
      {"fork", [] { return fork() > 0; }},
      {"fork by clone3",
       [] {
         std::uint64_t no_flags[11] = {};
         return syscall(SYS_clone3, no_flags, sizeof no_flags) > 0;
       }},
      {"run a program",
       [] {
         char name[] = "/bin/true";
         char* const words[] = {name, nullptr};
         pid_t pid = 0;
         return posix_spawn(&pid, name, nullptr, nullptr, words, environ) == 0;
       }},
      {"become a program",
       [] {
         execl("/bin/true", "true", nullptr);
         return false;
       }},
      {"trace", [&] { return ptrace(PTRACE_ATTACH, test, nullptr, nullptr) == 0; }},
      {"read memory",
       [&] {
         const iovec local{&byte, 1}, remote{&byte, 1};
         return process_vm_readv(test, &local, 1, &remote, 1, 0) == 1;
       }},
      {"read memory by file",
       [&] { return opens("/proc/" + std::to_string(test) + "/mem", O_RDONLY); }},
      {"share memory", [] { return shmget(IPC_PRIVATE, 4096, 0600) >= 0; }},
      {"limit its parent", [&] { return prlimit(test, RLIMIT_CORE, nullptr, nullptr) == 0; }},
      {"change its own limits",
       [] {
         rlimit limit{};
         return getrlimit(RLIMIT_DATA, &limit) == 0 && setrlimit(RLIMIT_DATA, &limit) == 0;
       }},
      {"make a namespace", [] { return unshare(CLONE_NEWUSER) == 0; }},
      {"trace the system", [] { return syscall(SYS_bpf, 0, nullptr, 0) != -1; }},
  };
  for (const auto& [what, attempt] : attempts) EXPECT_FALSE(succeeds(attempt)) << what;
}

TEST_F(SandboxTest, OfAnImporterLetsItForkAndEndWhatItForked) {
  const auto forks = [] {
    const pid_t child = fork();
    if (child == 0) {
      pause();
      _exit(0);
    }
    int status = 0;
    return child > 0 && kill(child, SIGKILL) == 0 && waitpid(child, &status, 0) == child &&
           WIFSIGNALED(status);
  };
  EXPECT_TRUE(succeeds(forks, Children::forked));
  EXPECT_FALSE(succeeds([] { return execl("/bin/true", "true", nullptr) == 0; }, Children::forked));
  EXPECT_FALSE(succeeds([] { return socket(AF_UNIX, SOCK_STREAM, 0) >= 0; }, Children::forked));
  // And what it forked can be confined again.
  EXPECT_FALSE(succeeds(
      [&] {
        enter(store());
        return fork() > 0;
      },
      Children::forked));
}

TEST_F(SandboxTest, HoldsThreadsThatADriverHasStartedBefore) {
  const pid_t child = fork();
  if (child == 0) {
    confine_driver();
    std::atomic<int> confined = 0, wrong = 0, asked = 0;
    std::thread driver([&] {
      while (confined == 0) std::this_thread::yield();
      wrong += socket(AF_UNIX, SOCK_STREAM, 0) >= 0 ? 1 : 0;
      wrong += opens(folder_ / "outside", O_WRONLY) ? 2 : 0;
      wrong += opens(folder_ / "new", O_WRONLY | O_CREAT) ? 4 : 0;
      wrong += opens("/dev/null", O_RDWR) ? 0 : 8;
      wrong += truncate((folder_ / "outside").c_str(), 0) == 0 ? 16 : 0;
      wrong += kill(getppid(), 0) == 0 ? 32 : 0;
      asked = 1;
    });
    enter(store());
    confined = 1;
    driver.join();
    _exit(asked == 1 ? wrong.load() : 99);
  }
  int status = 0;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
}

// NVIDIA's driver opens its device again for every buffer: a worker that could not had "no GL
// memory".
TEST_F(SandboxTest, LeavesOpenTheDevicesThatWereOpenAndNoOthers) {
  const int given = open("/dev/full", O_RDWR | O_CLOEXEC);
  const int device = open("/dev/zero", O_RDWR | O_CLOEXEC);
  ASSERT_GT(device, given);
  const auto devices = open_devices(given);
  EXPECT_NE(std::ranges::find(devices, fs::path("/dev/zero")), devices.end());
  EXPECT_EQ(std::ranges::find(devices, fs::path("/dev/full")), devices.end());
  close(device);
  close(given);
  const auto can = [&](const char* path, int flags) {
    return ended([&] { return opens(path, flags) ? 0 : 1; }, store(), {"/dev/zero"}) == 0;
  };
  EXPECT_TRUE(can("/dev/zero", O_RDWR));
  EXPECT_FALSE(can("/dev/null", O_RDWR));
  EXPECT_FALSE(can("/etc/passwd", O_RDONLY));
  EXPECT_FALSE(can("/dev", O_RDONLY));
  EXPECT_FALSE(succeeds([] { return opens("/dev/zero", O_RDWR); }));
}

TEST_F(SandboxTest, OfADeviceThatHasGoneIsNotSaidToConfine) {
  EXPECT_EQ(ended([] { return 0; }, store(), {"/dev/no-such-device"}), unconfined);
}

TEST(Confinement, SaysWhatItIsAndWhatItLacks) {
  EXPECT_EQ(describe({.kinds = "landlock 6, seccomp", .lacks = ""}), "landlock 6, seccomp");
  EXPECT_EQ(describe({.kinds = "seccomp", .lacks = "landlock: Function not implemented"}),
            "seccomp only; landlock: Function not implemented");
  EXPECT_EQ(describe({.kinds = "", .lacks = "landlock: a, seccomp: b"}),
            "none; landlock: a, seccomp: b");
}

}  // namespace
}  // namespace metamer::sandbox
