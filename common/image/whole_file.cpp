#include "common/image/whole_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <string>

namespace metamer {
namespace {

bool write_all(int descriptor, std::span<const std::byte> bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t written = ::write(descriptor, bytes.data() + done, bytes.size() - done);
    if (written < 0 && errno != EINTR) return false;
    if (written > 0) done += static_cast<std::size_t>(written);
  }
  return true;
}

}  // namespace

Result<void> write_whole_file(const std::filesystem::path& file,
                              const std::vector<unsigned char>& bytes) {
  const std::span<const std::byte> piece = std::as_bytes(std::span(bytes));
  return write_whole_file(file, std::span(&piece, 1));
}

Result<void> write_whole_file(const std::filesystem::path& file,
                              std::span<const std::span<const std::byte>> pieces) {
  const auto failure = [&](const std::filesystem::path& left_over) -> Result<void> {
    const std::string reason = std::strerror(errno);
    if (!left_over.empty()) ::unlink(left_over.c_str());
    return problem("can't be written: " + reason);
  };
  static std::atomic<unsigned> count = 0;
  const std::filesystem::path part =
      file.parent_path() / ("." + file.filename().string() + "." + std::to_string(::getpid()) +
                            "-" + std::to_string(++count) + ".part");
  const int descriptor =
      ::open(part.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0666);
  if (descriptor < 0) return failure({});
  for (const std::span<const std::byte> piece : pieces) {
    if (write_all(descriptor, piece)) continue;
    const int reason = errno;
    ::close(descriptor);
    errno = reason;
    return failure(part);
  }
  if (::close(descriptor) != 0) return failure(part);
  if (::rename(part.c_str(), file.c_str()) != 0) return failure(part);
  return {};
}

}  // namespace metamer
