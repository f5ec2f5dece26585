#include "server/service/executors/memory_limit.h"

#include <sys/resource.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <limits>

namespace metamer::service {

namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool sanitized = true;  // Its shadow counts as memory.
#else
constexpr bool sanitized = false;
#endif

}  // namespace

std::uint64_t data_bytes(pid_t process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmData:"))
      return std::strtoull(line.c_str() + std::strlen("VmData:"), nullptr, 10) << 10;
  return 0;
}

MemoryLimit::MemoryLimit(pid_t worker) : worker_(worker), own_(data_bytes(worker)), base_(own_) {
  if (sanitized) lacks_ = "it is built with a sanitizer";
  if (own_ == 0) lacks_ = "/proc does not say what it has";
}

std::string MemoryLimit::describe() const {
  return lacks_.empty() ? "limited for each job" : "not limited: " + lacks_;
}

void MemoryLimit::begin(std::uint64_t most_left) {
  const std::uint64_t now = data_bytes(worker_);
  base_ = own_ + std::min(now > own_ ? now - own_ : 0, most_left);
}

void MemoryLimit::allow(std::uint64_t bytes) {
  if (worker_ < 0 || !lacks_.empty()) return;
  rlimit limit{};
  if (::prlimit(worker_, RLIMIT_DATA, nullptr, &limit) == 0) {
    const bool fits = bytes < std::numeric_limits<std::uint64_t>::max() - base_;
    limit.rlim_cur = fits ? std::min<rlim_t>(base_ + bytes, limit.rlim_max) : limit.rlim_max;
    if (::prlimit(worker_, RLIMIT_DATA, &limit, nullptr) == 0) return;
  }
  if (errno != ESRCH) lacks_ = std::string("prlimit: ") + std::strerror(errno);
}

}  // namespace metamer::service
