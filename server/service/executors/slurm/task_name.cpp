#include "server/service/executors/slurm/task_name.h"

#include <sys/random.h>

#include <array>
#include <cerrno>
#include <system_error>

#include "common/digest.h"

namespace metamer::service {
namespace {

std::string random_hex() {
  std::array<char, 16> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size()))
    throw std::system_error(errno, std::generic_category(), "no random bytes");
  return to_hex(sha256({bytes.data(), bytes.size()})).substr(0, 32);
}

}  // namespace

std::string task_prefix(const std::string& server_id) {
  const std::string own = server_id.empty() ? random_hex() : to_hex(sha256(server_id));
  return "metamer-" + own.substr(0, 12) + "-";
}

std::string new_task_name(const std::string& prefix) { return prefix + random_hex(); }

}  // namespace metamer::service
