#pragma once

#include <sys/types.h>

#include <filesystem>

#include "common/problem.h"

namespace metamer::client {

/// Whether `user`, who listens at the Unix socket `path`, is the one to be met there: we ourselves,
/// root, or a user to whom root or we have given a folder above it (or the socket's file) where
/// nobody else could put one. In /tmp, say, anybody may have made the path first. Errors: who it is
/// instead.
Result<void> check_server_owner(uid_t user, const std::filesystem::path& path);

}  // namespace metamer::client
