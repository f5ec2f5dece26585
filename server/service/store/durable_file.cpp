#include "server/service/store/durable_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace metamer::service {

namespace {

void sync(const std::filesystem::path& path, int flags) {
  const int fd = ::open(path.c_str(), flags | O_RDONLY | O_CLOEXEC);
  if (fd < 0) throw std::system_error(errno, std::generic_category(), path.string());
  const int failed = ::fsync(fd) == 0 ? 0 : errno;
  ::close(fd);
  if (failed != 0) throw std::system_error(failed, std::generic_category(), path.string());
}

}  // namespace

void sync_file(const std::filesystem::path& file) {
  sync(file, 0);
  sync_folder(file.parent_path());
}

void sync_folder(const std::filesystem::path& folder) { sync(folder, O_DIRECTORY); }

}  // namespace metamer::service
