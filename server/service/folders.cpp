#include "server/service/folders.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <utility>

namespace metamer::service {

namespace fs = std::filesystem;

namespace {

constexpr const char* socket_name = "metamerd.sock";

wire::Endpoint socket_in(const fs::path& folder) {
  return {wire::Endpoint::Kind::unix_socket, (folder / socket_name).string(), {}, 0};
}

}  // namespace

Result<wire::Endpoint> default_endpoint() {
  if (const char* runtime = std::getenv("XDG_RUNTIME_DIR"); runtime && *runtime) {
    return socket_in(runtime);
  }
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
  const fs::path base = fs::temp_directory_path(error);
  std::string name = ((error ? fs::path("/tmp") : base) / "metamerd-XXXXXX").string();
  if (!::mkdtemp(name.data())) {
    return problem("can't make a temporary folder " + name + ": " + std::strerror(errno));
  }
  return TemporaryFolder(name);
}

TemporaryFolder::TemporaryFolder(TemporaryFolder&& other) noexcept
    : path_(std::exchange(other.path_, {})) {}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_, ignored);
}

fs::path default_worker() {
  std::error_code error;
  const fs::path self = fs::read_symlink("/proc/self/exe", error);
  return error ? fs::path("metamer-worker") : self.parent_path() / "metamer-worker";
}

}  // namespace metamer::service
