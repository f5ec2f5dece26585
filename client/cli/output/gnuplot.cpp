#include "client/cli/output/gnuplot.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <utility>

namespace metamer::cli {
namespace {

namespace fs = std::filesystem;

/// A file descriptor, closed with its object.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {}
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  int get() const { return fd_; }

 private:
  int fd_;
};

/// What becomes `file` once it is whole; until then it stands beside it, and goes with its object.
class PartFile {
 public:
  explicit PartFile(const fs::path& file)
      : file_(file),
        part_(file.parent_path() /
              ("." + file.filename().string() + "." + std::to_string(::getpid()) + ".part")),
        descriptor_(
            ::open(part_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0666)) {}
  PartFile(const PartFile&) = delete;
  PartFile& operator=(const PartFile&) = delete;
  ~PartFile() {
    if (descriptor_.get() >= 0 && !kept_) ::unlink(part_.c_str());
  }
  int descriptor() const { return descriptor_.get(); }
  /// With errno set on failure.
  bool keep() { return kept_ = ::rename(part_.c_str(), file_.c_str()) == 0; }

 private:
  fs::path file_, part_;
  Descriptor descriptor_;
  bool kept_ = false;
};

tl::unexpected<Problem> cannot_write(const fs::path& file) {
  const std::string reason = std::strerror(errno);
  return tl::unexpected<Problem>(
      {.field = {}, .file = file.string(), .message = "can't be written: " + reason});
}

bool write_all(int fd, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(fd, text.data(), text.size());
    if (written < 0 && errno != EINTR) return false;
    if (written > 0) text.remove_prefix(static_cast<std::size_t>(written));
  }
  return true;
}

/// The first bytes of a file that somebody else has filled.
std::string start_of(int fd, std::size_t limit) {
  std::string text(limit, '\0');
  const ssize_t count = ::pread(fd, text.data(), limit, 0);
  text.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
  return text;
}

/// Runs gnuplot with these files as its stdin, stdout and stderr. Its exit status, or -1 with
/// errno.
int run_gnuplot(int in, int out, int err) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, in, 0);
  posix_spawn_file_actions_adddup2(&actions, out, 1);
  posix_spawn_file_actions_adddup2(&actions, err, 2);
  // -d: no start-up files; -: the script comes on stdin.
  std::array<std::string, 3> words = {"gnuplot", "-d", "-"};
  std::array<char*, 4> arguments = {words[0].data(), words[1].data(), words[2].data(), nullptr};
  pid_t pid = -1;
  const int error =
      ::posix_spawnp(&pid, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) {
    errno = error;
    return -1;
  }
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0)
    if (errno != EINTR) return -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// A file in memory, for what a child reads or says.
int nameless_file() { return ::memfd_create("metamer-plot", MFD_CLOEXEC); }

}  // namespace

Result<void> write_text_file(const fs::path& file, const std::string& text) {
  PartFile part(file);
  if (part.descriptor() < 0 || !write_all(part.descriptor(), text) || !part.keep())
    return cannot_write(file);
  return {};
}

Result<void> draw_png(const std::string& script, const fs::path& file) {
  // A file takes the script, and another what gnuplot says: neither can fill up as a pipe does.
  PartFile picture(file);
  if (picture.descriptor() < 0) return cannot_write(file);
  const Descriptor input(nameless_file()), said(nameless_file());
  if (input.get() < 0 || said.get() < 0 || !write_all(input.get(), script) ||
      ::lseek(input.get(), 0, SEEK_SET) != 0)
    return problem(std::string("can't write the script for gnuplot: ") + std::strerror(errno));

  const int status = run_gnuplot(input.get(), picture.descriptor(), said.get());
  if (status < 0 && errno == ENOENT)
    return problem("there is no gnuplot to draw with; install the package gnuplot-nox");
  if (status < 0) return problem(std::string("can't start gnuplot: ") + std::strerror(errno));
  if (status != 0 || start_of(picture.descriptor(), 8) != "\x89PNG\r\n\x1a\n")
    return problem("gnuplot drew nothing (exit code " + std::to_string(status) +
                   "): " + start_of(said.get(), 400));
  if (!picture.keep()) return cannot_write(file);
  return {};
}

std::string gnuplot_quote(const std::string& words) {
  std::string result = "'";
  for (const char c : words) {
    const bool control = static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
    result += c == '\'' ? "''" : std::string(1, control ? '?' : c);
  }
  return result + "'";
}

}  // namespace metamer::cli
