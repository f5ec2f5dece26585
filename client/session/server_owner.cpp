#include "client/session/server_owner.h"

#include <sys/stat.h>
#include <unistd.h>

#include <string>
#include <system_error>

namespace metamer::client {

namespace fs = std::filesystem;

namespace {

tl::unexpected<Problem> stranger(uid_t user, const fs::path& path) {
  return problem("uid " + std::to_string(user) + " listens at " + path.string() +
                 ", where neither root nor you have let that user; nothing was sent");
}

}  // namespace

Result<void> check_server_owner(uid_t user, const fs::path& path) {
  const auto trusted = [](uid_t owner) { return owner == ::geteuid() || owner == 0; };
  if (trusted(user)) return {};

  // From the root down: as long as only the trusted can make entries, their owners are as wanted.
  std::error_code error;
  const fs::path folder = fs::canonical(fs::absolute(path, error).parent_path(), error);
  if (error) return stranger(user, path);
  fs::path at;
  for (const fs::path& part : folder / path.filename()) {
    at /= part;
    struct stat status {};
    if (::lstat(at.c_str(), &status) != 0) return stranger(user, path);
    if (status.st_uid == user) return {};
    const bool others_write = (status.st_mode & (S_IWGRP | S_IWOTH)) != 0;
    if (!trusted(status.st_uid) || others_write) return stranger(user, path);
  }
  return stranger(user, path);
}

}  // namespace metamer::client
