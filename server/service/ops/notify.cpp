#include "server/service/ops/notify.h"

#include <sys/stat.h>
#include <systemd/sd-daemon.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "common/printable.h"

namespace metamer::service::notify {

void ready() { ::sd_notify(0, "READY=1"); }

void reloading() {
  timespec now{};
  ::clock_gettime(CLOCK_MONOTONIC, &now);
  const std::uint64_t microseconds = static_cast<std::uint64_t>(now.tv_sec) * 1'000'000 +
                                     static_cast<std::uint64_t>(now.tv_nsec) / 1000;
  ::sd_notify(0, ("RELOADING=1\nMONOTONIC_USEC=" + std::to_string(microseconds)).c_str());
}

void stopping(std::chrono::milliseconds at_most) {
  const auto microseconds = std::chrono::microseconds(at_most).count();
  ::sd_notify(0, ("STOPPING=1\nEXTEND_TIMEOUT_USEC=" + std::to_string(microseconds)).c_str());
}

void status(const std::string& line) { ::sd_notify(0, ("STATUS=" + printable(line)).c_str()); }

std::vector<int> listening_descriptors() {
  std::vector<int> descriptors;
  for (int given = ::sd_listen_fds(1), i = 0; i < given; ++i)
    descriptors.push_back(SD_LISTEN_FDS_START + i);
  return descriptors;
}

std::optional<std::chrono::milliseconds> watchdog_interval() {
  std::uint64_t microseconds = 0;
  if (::sd_watchdog_enabled(0, &microseconds) <= 0) return std::nullopt;
  return std::chrono::milliseconds(std::max<std::uint64_t>(microseconds / 2000, 1));
}

void alive() { ::sd_notify(0, "WATCHDOG=1"); }

bool logs_to_journal() {
  const char* named = std::getenv("JOURNAL_STREAM");
  struct stat status {};
  if (!named || ::fstat(STDERR_FILENO, &status) != 0) return false;
  return named == std::to_string(status.st_dev) + ":" + std::to_string(status.st_ino);
}

}  // namespace metamer::service::notify
