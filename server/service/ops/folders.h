#pragma once

#include <filesystem>

#include "common/problem.h"
#include "common/wire/endpoint.h"

namespace metamer::service {

/// Where the daemon listens unless told otherwise: metamerd.sock in $XDG_RUNTIME_DIR, else in
/// /run/metamer where that is a folder of the daemon's user alone to write (systemd's
/// RuntimeDirectory=), else in /tmp/metamer-UID, a folder of mode 0700. Errors: that folder belongs
/// to somebody else, or others may enter it.
Result<wire::Endpoint> default_endpoint();

/// A folder of its own under the system's folder for temporary files, removed with everything in
/// it. Those of daemons that were killed before they could do so are removed when one is made.
class TemporaryFolder {
 public:
  static Result<TemporaryFolder> make();
  ~TemporaryFolder();
  TemporaryFolder(TemporaryFolder&& other) noexcept;
  TemporaryFolder& operator=(TemporaryFolder&&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  TemporaryFolder(std::filesystem::path path, int lock) : path_(std::move(path)), lock_(lock) {}
  std::filesystem::path path_;
  int lock_;  ///< Held on the folder as long as its daemon lives.
};

/// Raises the number of open files that the process may have to what the system allows it: each
/// session takes one.
void allow_descriptors();

/// metamer-worker beside the running executable.
std::filesystem::path default_worker();

}  // namespace metamer::service
