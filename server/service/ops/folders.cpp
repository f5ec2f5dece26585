#include "server/service/ops/folders.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <string_view>
#include <utility>

namespace metamer::service {

namespace fs = std::filesystem;

namespace {

constexpr const char* socket_name = "metamerd.sock";

wire::Endpoint socket_in(const fs::path& folder) {
  return {wire::Endpoint::Kind::unix_socket, (folder / socket_name).string(), {}, 0};
}

/// A folder that this process may make entries in, and no other user may.
bool is_ours(const fs::path& folder) {
  struct stat status {};
  return ::lstat(folder.c_str(), &status) == 0 && S_ISDIR(status.st_mode) &&
         status.st_uid == ::geteuid() && (status.st_mode & (S_IWGRP | S_IWOTH)) == 0;
}

constexpr std::string_view temporary_pattern = "metamerd-temporary-XXXXXX";
constexpr std::string_view temporary_prefix = "metamerd-temporary-";

/// A descriptor that holds the folder's lock; -1 where somebody else does, or it is no folder of
/// ours.
int lock_folder(const fs::path& folder) {
  const int fd = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC);
  struct stat status {};
  if (fd >= 0 && ::fstat(fd, &status) == 0 && status.st_uid == ::getuid() &&
      ::flock(fd, LOCK_EX | LOCK_NB) == 0) {
    return fd;
  }
  if (fd >= 0) ::close(fd);
  return -1;
}

/// Removes the folders of daemons that have ended without doing so: nobody holds their locks. Young
/// ones are left alone, for their daemon may be about to take its lock.
void remove_orphans(const fs::path& base) {
  const auto old = fs::file_time_type::clock::now() - std::chrono::minutes(1);
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(base, ignored)) {
    if (!entry.path().filename().string().starts_with(temporary_prefix)) continue;
    if (entry.last_write_time(ignored) > old) continue;
    const int lock = lock_folder(entry.path());
    if (lock < 0) continue;
    fs::remove_all(entry.path(), ignored);
    ::close(lock);
  }
}

}  // namespace

Result<wire::Endpoint> default_endpoint() {
  if (const char* runtime = std::getenv("XDG_RUNTIME_DIR"); runtime && *runtime) {
    return socket_in(runtime);
  }
  if (const fs::path runtime = "/run/metamer"; is_ours(runtime)) return socket_in(runtime);
  // Anybody may have made a folder of that name in /tmp, to listen to what is said there.
  const fs::path folder = "/tmp/metamer-" + std::to_string(::getuid());
  if (::mkdir(folder.c_str(), 0700) != 0 && errno != EEXIST) {
    return problem("can't make " + folder.string() + ": " + std::strerror(errno));
  }
  struct stat status {};
  if (::lstat(folder.c_str(), &status) != 0 || !S_ISDIR(status.st_mode) ||
      status.st_uid != ::getuid() || (status.st_mode & 0077) != 0) {
    return problem(folder.string() + " is not a folder that only you can enter");
  }
  return socket_in(folder);
}

Result<TemporaryFolder> TemporaryFolder::make() {
  std::error_code error;
  fs::path base = fs::temp_directory_path(error);
  if (error) base = "/tmp";
  remove_orphans(base);
  std::string name = (base / temporary_pattern).string();
  if (!::mkdtemp(name.data())) {
    return problem("can't make a temporary folder " + name + ": " + std::strerror(errno));
  }
  return TemporaryFolder(name, lock_folder(name));
}

TemporaryFolder::TemporaryFolder(TemporaryFolder&& other) noexcept
    : path_(std::exchange(other.path_, {})), lock_(std::exchange(other.lock_, -1)) {}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_, ignored);
  if (lock_ >= 0) ::close(lock_);
}

void allow_descriptors() {
  rlimit limit{};
  if (::getrlimit(RLIMIT_NOFILE, &limit) != 0) return;
  limit.rlim_cur = limit.rlim_max;
  ::setrlimit(RLIMIT_NOFILE, &limit);
}

fs::path default_worker() {
  std::error_code error;
  const fs::path self = fs::read_symlink("/proc/self/exe", error);
  return error ? fs::path("metamer-worker") : self.parent_path() / "metamer-worker";
}

}  // namespace metamer::service
