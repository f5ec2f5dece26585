#include "server/service/assets/file_reader.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <new>
#include <utility>

namespace metamer::service {

FileReader::~FileReader() {
  stop();
  thread_.join();
}

void FileReader::check(std::filesystem::path file, const Digest& digest, asio::any_io_executor loop,
                       std::function<void(Verdict)> done) {
  asio::post(thread_, [this, file = std::move(file), digest, loop = std::move(loop),
                       done = std::move(done)]() mutable {
    const Verdict verdict = has_digest(file, digest);
    asio::post(loop, [done = std::move(done), verdict] { done(verdict); });
  });
}

FileReader::Verdict FileReader::has_digest(const std::filesystem::path& path,
                                           const Digest& digest) try {
  const int file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (file < 0 && (errno == EMFILE || errno == ENFILE || errno == ENOMEM)) return std::nullopt;
  DigestStream sum;
  ssize_t got = file < 0 ? -1 : 1;
  while (got > 0 && !stopped_) {
    do got = ::read(file, piece_.data(), piece_.size());
    while (got < 0 && errno == EINTR);
    if (got > 0) sum.update({piece_.data(), static_cast<std::size_t>(got)});
  }
  if (file >= 0) ::close(file);
  if (stopped_) return std::nullopt;
  return got == 0 && sum.finish() == digest;
} catch (const std::bad_alloc&) {
  return std::nullopt;
}

}  // namespace metamer::service
