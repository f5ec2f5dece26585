#include "server/batch/own_worker.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <utility>
#include <vector>

#include "common/wire/blocking.h"
#include "common/wire/worker_exit.h"

namespace metamer::batch {
namespace {

// The worker's descriptors.
constexpr int worker_socket = 3;
constexpr int worker_film = 4;
/// Heartbeats come four times a second; a node may be busy with others' work.
constexpr std::chrono::milliseconds most_silence{30'000};

tl::unexpected<Problem> system_problem(const std::string& what, int error) {
  return problem(what + ": " + std::strerror(error));
}

/// A descriptor above those that the worker is given, so that none is overwritten before it is
/// copied.
int raised(int fd) {
  if (fd < 0 || fd > 9) return fd;
  const int copy = ::fcntl(fd, F_DUPFD_CLOEXEC, 10);
  ::close(fd);
  return copy;
}

/// Returns 0 or an errno.
int spawn(const WorkerWords& words, int socket, int film, pid_t& pid) {
  std::vector<std::string> all = {words.program.string(), "--store", words.store.string(),
                                  "--threads", std::to_string(words.threads),
                                  // As on each other node, whatever the processor has.
                                  "--isa", "avx2"};
  if (!words.gl_device.empty()) all.insert(all.end(), {"--gl-device", words.gl_device});
  if (words.unconfined) all.insert(all.end(), {"--unconfined", "yes"});
  std::vector<char*> arguments;
  for (std::string& word : all) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, socket, worker_socket);
  posix_spawn_file_actions_adddup2(&actions, film, worker_film);
  posix_spawn_file_actions_addclosefrom_np(&actions, worker_film + 1);
  const int error = posix_spawn(&pid, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

}  // namespace

Result<OwnWorker> OwnWorker::start(const WorkerWords& words) {
  int pair[2];
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair) != 0)
    return system_problem("no socket", errno);
  const int theirs = raised(pair[1]);
  OwnWorker worker(-1, raised(pair[0]),
                   raised(::memfd_create("metamer-film", MFD_CLOEXEC | MFD_ALLOW_SEALING)));
  int error = errno;
  if (theirs >= 0 && worker.socket_ >= 0 && worker.film_ >= 0)
    error = ::fcntl(worker.film_, F_ADD_SEALS, F_SEAL_SHRINK) == 0
                ? spawn(words, theirs, worker.film_, worker.pid_)
                : errno;
  if (theirs >= 0) ::close(theirs);
  if (worker.pid_ < 0) return system_problem("can't start " + words.program.string(), error);
  return worker;
}

OwnWorker::OwnWorker(OwnWorker&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)),
      socket_(std::exchange(other.socket_, -1)),
      film_(std::exchange(other.film_, -1)),
      film_bytes_(std::exchange(other.film_bytes_, nullptr)),
      film_size_(other.film_size_) {}

OwnWorker::~OwnWorker() {
  (void)end();
  if (film_bytes_) ::munmap(film_bytes_, film_size_);
  if (socket_ >= 0) ::close(socket_);
  if (film_ >= 0) ::close(film_);
}

/// How it ended, when it is gone.
std::string OwnWorker::end() {
  if (pid_ < 0) return "is gone";
  ::kill(pid_, SIGKILL);
  int status = 0;
  ::waitpid(std::exchange(pid_, -1), &status, 0);
  return wire::describe_exit(status);
}

tl::unexpected<Problem> OwnWorker::distrust(const std::string& what) {
  (void)end();
  return problem(what);
}

void OwnWorker::send(const v1::WorkerEnvelope& message) {
  (void)wire::write_envelope(socket_, message);
}

Result<v1::WorkerEnvelope> OwnWorker::next() {
  pollfd waiting{socket_, POLLIN, 0};
  int got = 0;
  do {
    got = ::poll(&waiting, 1, static_cast<int>(most_silence.count()));
  } while (got < 0 && errno == EINTR);
  if (got <= 0) return distrust("stopped answering: no sign of life for 30 s");
  auto message = wire::read_envelope(socket_);
  if (!message) return distrust("sent what can't be read: " + message.error().message);
  if (*message) return **std::move(message);
  // It has closed its socket, as it ends: a moment until it has.
  for (int i = 0; i < 100 && pid_ > 0; ++i) {
    int status = 0;
    if (::waitpid(pid_, &status, WNOHANG) == pid_) {
      pid_ = -1;
      return problem(wire::describe_exit(status));
    }
    ::usleep(10'000);
  }
  return distrust("closed its connection");
}

bool OwnWorker::size_film(std::size_t bytes) {
  if (film_bytes_ || ::ftruncate(film_, static_cast<off_t>(bytes)) != 0) return false;
  void* const memory = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, film_, 0);
  if (memory == MAP_FAILED) return false;
  film_bytes_ = static_cast<char*>(memory);
  film_size_ = bytes;
  return true;
}

Result<void> OwnWorker::fill_film(const std::filesystem::path& picture) {
  std::ifstream in(picture, std::ios::binary);
  if (!in.read(film_bytes_, static_cast<std::streamsize>(film_size_)) || in.get() >= 0)
    return problem(picture.string() + ": is not the whole picture");
  return {};
}

}  // namespace metamer::batch
