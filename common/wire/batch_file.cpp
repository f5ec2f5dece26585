#include "common/wire/batch_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

#include "common/digest.h"

namespace metamer::wire {
namespace {

constexpr std::string_view first_line = "metamer batch 1\n";
constexpr std::size_t head_size = first_line.size() + sizeof(Digest);

class OpenFile {
 public:
  OpenFile(const std::filesystem::path& path, int flags)
      : fd_(::open(path.c_str(), flags | O_CLOEXEC, 0600)) {}
  ~OpenFile() {
    if (fd_ >= 0) ::close(fd_);
  }
  OpenFile(const OpenFile&) = delete;
  int get() const { return fd_; }
  /// What a disk of another machine has to say may come as late as this.
  bool close() { return ::close(std::exchange(fd_, -1)) == 0; }

 private:
  int fd_;
};

tl::unexpected<Problem> batch_problem(const std::filesystem::path& file, const std::string& what) {
  return problem(file.string() + ": " + what);
}

bool write_all(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

/// Closes, too.
bool write_new(const std::filesystem::path& part, std::string_view head, std::string_view body) {
  OpenFile out(part, O_WRONLY | O_CREAT | O_TRUNC);
  return out.get() >= 0 && write_all(out.get(), head) && write_all(out.get(), body) &&
         ::fsync(out.get()) == 0 && out.close();
}

/// By a name of the process's own: two attempts may write at a time.
std::filesystem::path part_of(const std::filesystem::path& file) {
  char host[65] = {};
  (void)::gethostname(host, sizeof host - 1);
  return file.string() + ".part-" + host + "-" + std::to_string(::getpid());
}

Result<void> write_message(const std::filesystem::path& file,
                           const google::protobuf::MessageLite& message) {
  std::string body;
  if (message.ByteSizeLong() > max_batch_file - head_size)
    return batch_problem(file, "larger than such a file may be");
  message.SerializeToString(&body);
  const Digest digest = sha256(body);
  const std::filesystem::path part = part_of(file);
  const bool written =
      write_new(part, std::string(first_line) + std::string(to_bytes(digest)), body) &&
      ::rename(part.c_str(), file.c_str()) == 0;
  if (!written) {
    const int error = errno;
    ::unlink(part.c_str());
    return batch_problem(file, std::strerror(error));
  }
  const OpenFile folder(file.parent_path(), O_RDONLY | O_DIRECTORY);
  if (folder.get() < 0 || ::fsync(folder.get()) != 0)
    return batch_problem(file, std::strerror(errno));
  return {};
}

Result<std::string> read_body(const std::filesystem::path& file) {
  const OpenFile in(file, O_RDONLY | O_NONBLOCK);
  struct stat status {};
  if (in.get() < 0 || ::fstat(in.get(), &status) != 0)
    return batch_problem(file, std::strerror(errno));
  const auto size = static_cast<std::size_t>(status.st_size);
  if (!S_ISREG(status.st_mode) || size < head_size || size > max_batch_file)
    return batch_problem(file, "is no file of an order or a result");
  std::string bytes(size, '\0');
  for (std::size_t at = 0; at < size;) {
    const ssize_t got = ::read(in.get(), bytes.data() + at, size - at);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return batch_problem(file, got < 0 ? std::strerror(errno) : "became shorter");
    at += static_cast<std::size_t>(got);
  }
  const std::string_view all = bytes;
  const std::string_view body = all.substr(head_size);
  if (!all.starts_with(first_line) ||
      all.substr(first_line.size(), sizeof(Digest)) != to_bytes(sha256(body)))
    return batch_problem(file, "has other bytes than were written");
  bytes.erase(0, head_size);
  return bytes;
}

template <class Message>
Result<Message> read_message(const std::filesystem::path& file) {
  const auto body = read_body(file);
  if (!body) return tl::unexpected(body.error());
  Message message;
  if (!message.ParseFromString(*body)) return batch_problem(file, "holds another message");
  return message;
}

}  // namespace

Result<void> write_batch_file(const std::filesystem::path& file, const v1::BatchOrder& order) {
  return write_message(file, order);
}

Result<void> write_batch_file(const std::filesystem::path& file, const v1::BatchResult& result) {
  return write_message(file, result);
}

Result<v1::BatchOrder> read_batch_order(const std::filesystem::path& file) {
  return read_message<v1::BatchOrder>(file);
}

Result<v1::BatchResult> read_batch_result(const std::filesystem::path& file) {
  return read_message<v1::BatchResult>(file);
}

}  // namespace metamer::wire
