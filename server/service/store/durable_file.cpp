#include "server/service/store/durable_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <memory>
#include <string>
#include <string_view>

namespace metamer::service {

namespace {

/// As much as a client sends at once.
constexpr std::uint64_t most_tried_bytes = 4u << 20;

void sync(const std::filesystem::path& path, int flags) {
  const int fd = ::open(path.c_str(), flags | O_RDONLY | O_CLOEXEC);
  if (fd < 0) throw std::system_error(errno, std::generic_category(), path.string());
  const int failed = ::fsync(fd) == 0 ? 0 : errno;
  ::close(fd);
  if (failed != 0) throw SyncError(failed, std::generic_category(), path.string());
}

}  // namespace

Result<void> make_folder(const std::filesystem::path& folder, const std::string& what) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) return problem("can't make " + what + " " + folder.string() + ": " + error.message());
  if (::access(folder.c_str(), W_OK | X_OK) == 0) return {};
  const char* const read_only =
      errno == EROFS ? ", which is on a disk that is mounted read-only" : "";
  return problem("can't write into " + what + " " + folder.string() + read_only + ": " +
                 std::strerror(errno));
}

void sync_file(const std::filesystem::path& file) {
  sync(file, 0);
  sync_folder(file.parent_path());
}

void write_zeros(const std::filesystem::path& file, std::uint64_t bytes) {
  const int fd = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  int failed = fd < 0 ? errno : 0;
  const std::string zeros(static_cast<std::size_t>(bytes), '\0');
  for (std::string_view rest = zeros; failed == 0 && !rest.empty();) {
    const ssize_t written = ::write(fd, rest.data(), rest.size());
    if (written >= 0) rest.remove_prefix(static_cast<std::size_t>(written));
    if (written < 0 && errno != EINTR) failed = errno;
  }
  if (failed == 0 && ::fsync(fd) != 0) failed = errno;
  if (fd >= 0) ::close(fd);
  if (failed != 0) throw std::system_error(failed, std::generic_category(), file.string());
}

void try_to_write(const std::filesystem::path& file, std::uint64_t bytes) {
  const std::shared_ptr<void> remove(nullptr, [&](void*) { ::unlink(file.c_str()); });
  write_zeros(file, std::min(bytes, most_tried_bytes));
}

void sync_folder(const std::filesystem::path& folder) { sync(folder, O_DIRECTORY); }

}  // namespace metamer::service
