#include "server/service/executors/worker_process.h"

#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <spdlog/spdlog.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <utility>
#include <vector>

#include "common/wire/worker_exit.h"
#include "server/service/executors/kept_environment.h"

namespace metamer::service {

namespace {

// The child's descriptors.
constexpr int child_socket = 3;
constexpr int child_film = 4;
/// A worker that has closed its socket is about to exit; if not by then, it is ended.
constexpr std::chrono::seconds exit_grace{1};

/// A descriptor that is closed unless it is released. Above those that the child is given, so that
/// none is overwritten there before it is copied.
class Descriptor {
 public:
  explicit Descriptor(int fd) : fd_(fd) {
    if (fd_ < 0 || fd_ > 9) return;
    fd_ = ::fcntl(fd, F_DUPFD_CLOEXEC, 10);
    ::close(fd);
  }
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int get() const { return fd_; }
  int release() { return std::exchange(fd_, -1); }

 private:
  int fd_;
};

/// What a worker gets of our own environment: what finds and steers GL drivers and the sanitizers
/// of a build, what the tracer is to use, and Metamer's own tests.
std::vector<char*> worker_environment() {
  constexpr std::string_view kept[] = {"LD_LIBRARY_PATH=",
                                       "LIBGL_",
                                       "MESA_",
                                       "GALLIUM_",
                                       "LP_",
                                       "DRI_",
                                       "EGL_",
                                       "__EGL_",
                                       "__GL_",
                                       "__GLX_",
                                       "NVIDIA_",
                                       "CUDA_VISIBLE_",
                                       "VK_",
                                       "METAMER_ISA=",
                                       "METAMER_TEST_",
                                       "ASAN_OPTIONS=",
                                       "LSAN_OPTIONS=",
                                       "TSAN_OPTIONS=",
                                       "UBSAN_OPTIONS="};
  return kept_environment(kept);
}

/// Runs the command with `socket` and `film` as its descriptors 3 and 4 and no others but stderr.
/// Returns 0 or an errno.
int start(const WorkerCommand& command, int socket, int film, pid_t& pid) {
  std::vector<std::string> words = {command.program.string(), "--store", command.store.string(),
                                    "--threads", std::to_string(command.threads)};
  if (command.backend == v1::GL)
    words.insert(words.end(), {std::string("--gl-device"), command.gl_device});
  if (command.niceness != 0)
    words.insert(words.end(), {"--nice", std::to_string(command.niceness)});
  if (!command.group.empty()) words.insert(words.end(), {"--group", command.group.string()});
  if (command.isa != "native") words.insert(words.end(), {"--isa", command.isa});
  if (command.unconfined) words.insert(words.end(), {"--unconfined", "yes"});
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::vector<char*> environment = worker_environment();

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, STDERR_FILENO, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, socket, child_socket);
  posix_spawn_file_actions_adddup2(&actions, film, child_film);
  posix_spawn_file_actions_addclosefrom_np(&actions, child_film + 1);

  // In a group of its own: Ctrl-C in a terminal is the daemon's to hear, and signals that the
  // daemon has blocked or ignored mean nothing there.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none;
  sigset_t all;
  sigemptyset(&none);
  sigfillset(&all);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setsigdefault(&attributes, &all);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(
      &attributes,
      static_cast<short>(POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETPGROUP));
  const int error =
      posix_spawn(&pid, arguments[0], &actions, &attributes, arguments.data(), environment.data());
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

/// Of what earlier jobs left there. By a hole: it can't become shorter, and the worker may still
/// have all of it mapped.
bool clear(int film) {
  const off_t size = ::lseek(film, 0, SEEK_END);
  return size == 0 || ::fallocate(film, FALLOC_FL_PUNCH_HOLE | FALLOC_FL_KEEP_SIZE, 0, size) == 0;
}

bool is_shortage(int error) {
  return error == EMFILE || error == ENFILE || error == EAGAIN || error == ENOMEM ||
         error == ENOBUFS || error == ENOSPC;
}

}  // namespace

tl::expected<std::shared_ptr<WorkerProcess>, WorkerProcess::SpawnError> WorkerProcess::spawn(
    const asio::any_io_executor& executor, const WorkerCommand& command, Handlers handlers) {
  const auto failed = [&](int error) {
    return tl::unexpected(
        SpawnError{"can't start " + command.program.string() + ": " + std::strerror(error),
                   is_shortage(error)});
  };
  std::array<int, 2> pair{-1, -1};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair.data()) != 0) return failed(errno);
  Descriptor ours(pair[0]);
  Descriptor theirs(pair[1]);
  Descriptor film(::memfd_create("metamer-film", MFD_CLOEXEC | MFD_ALLOW_SEALING));
  if (film.get() < 0 || ours.get() < 0 || theirs.get() < 0) return failed(errno);
  if (::fcntl(film.get(), F_ADD_SEALS, F_SEAL_SHRINK | F_SEAL_SEAL) != 0) return failed(errno);

  pid_t pid = -1;
  if (const int error = start(command, theirs.get(), film.get(), pid); error != 0) {
    return failed(error);
  }
  // By number: Debian's <sys/pidfd.h> declares the function as C++.
  const int pidfd = static_cast<int>(::syscall(SYS_pidfd_open, pid, 0));
  if (pidfd < 0) {
    const int error = errno;
    ::kill(pid, SIGKILL);
    ::waitpid(pid, nullptr, 0);
    return failed(error);
  }
  boost::system::error_code error;
  wire::Socket socket(executor);
  asio::posix::stream_descriptor exit(executor);
  socket.assign(asio::local::stream_protocol(), ours.get(), error);
  if (!error) ours.release(), exit.assign(pidfd, error);
  if (error) {
    ::kill(pid, SIGKILL);
    ::waitpid(pid, nullptr, 0);
    if (!exit.is_open()) ::close(pidfd);
    return failed(error.value());
  }
  auto process = std::shared_ptr<WorkerProcess>(new WorkerProcess(
      pid, std::move(exit), film.release(), std::move(socket), std::move(handlers)));
  process->run();
  return process;
}

WorkerProcess::WorkerProcess(pid_t pid, asio::posix::stream_descriptor exit, int film,
                             wire::Socket socket, Handlers handlers)
    : pid_(pid),
      film_(film),
      exit_(std::move(exit)),
      channel_(std::move(socket), wire::Peer::worker),
      handlers_(std::move(handlers)),
      unsent_signal_(channel_.executor(), asio::steady_timer::time_point::max()),
      grace_(channel_.executor()) {}

WorkerProcess::~WorkerProcess() {
  abandon();
  unmap_film();
  ::close(film_);
}

void WorkerProcess::run() {
  const auto self = shared_from_this();
  const auto keep = [self](const std::exception_ptr& error) {
    try {
      if (error) std::rethrow_exception(error);
    } catch (const std::exception& exception) {
      spdlog::error("worker {} is ended: {}", self->pid_, exception.what());
      self->kill(exception.what());
    }
  };
  asio::co_spawn(channel_.executor(), read_messages(), keep);
  asio::co_spawn(channel_.executor(), write_messages(), keep);
  asio::co_spawn(channel_.executor(), await_exit(), keep);
}

void WorkerProcess::send(v1::WorkerEnvelope message) {
  unsent_.push_back(std::move(message));
  unsent_signal_.cancel();
}

asio::awaitable<void> WorkerProcess::hear_messages() {
  while (true) {
    v1::WorkerEnvelope message;
    const auto got = co_await channel_.read(message);
    if (!got) {
      if (got.error().kind == wire::ChannelError::Kind::frame) {
        kill("sent a frame that can't be read: " + got.error().message);
      }
      break;
    }
    // What a process says that is being ended is not heard.
    if (kill_reason_.empty() && handlers_.message) handlers_.message(std::move(message));
  }
}

asio::awaitable<void> WorkerProcess::read_messages() {
  // A worker decides what its messages cost: the memory that one takes may not be there.
  try {
    co_await hear_messages();
  } catch (const std::exception& exception) {
    kill(std::string("sent a message that could not be handled: ") + exception.what());
  }
  reading_ = false;
  report_if_over();

  // A process that closes its socket has to exit.
  if (status_) co_return;
  grace_.expires_after(exit_grace);
  const auto [cancelled] = co_await grace_.async_wait(asio::as_tuple(asio::use_awaitable));
  if (!cancelled) kill("closed its connection");
}

asio::awaitable<void> WorkerProcess::write_messages() {
  while (channel_.is_open()) {
    if (unsent_.empty()) {
      co_await unsent_signal_.async_wait(asio::as_tuple(asio::use_awaitable));
      continue;
    }
    const v1::WorkerEnvelope message = std::move(unsent_.front());
    unsent_.pop_front();
    const auto sent = co_await channel_.write(message);
    // A worker that can't be written to is about to exit; its exit says why.
    if (!sent) co_return;
  }
}

asio::awaitable<void> WorkerProcess::await_exit() {
  const auto [error] = co_await exit_.async_wait(asio::posix::stream_descriptor::wait_read,
                                                 asio::as_tuple(asio::use_awaitable));
  if (error || status_) co_return;
  int status = 0;
  ::waitpid(pid_, &status, 0);
  status_ = status;
  grace_.cancel();
  // What it sent before it ended still counts: the reader comes to the end by itself.
  channel_.shutdown_receive();
  report_if_over();
}

void WorkerProcess::report_if_over() {
  if (reading_ || !status_) return;
  channel_.close();
  unsent_signal_.cancel();
  const auto exit = std::exchange(handlers_, {}).exit;
  if (exit) exit(kill_reason_.empty() ? wire::describe_exit(*status_) : kill_reason_);
}

bool WorkerProcess::ran_out_of_memory(bool kernel) const {
  return kill_reason_.empty() && status_ && wire::is_out_of_memory(*status_, kernel);
}

bool WorkerProcess::size_film(std::uint64_t bytes) {
  unmap_film();
  if (!clear(film_)) return false;
  const auto size = static_cast<off_t>(bytes);
  if (::lseek(film_, 0, SEEK_END) < size && ::ftruncate(film_, size) != 0) return false;
  void* const memory = ::mmap(nullptr, bytes, PROT_READ, MAP_SHARED, film_, 0);
  if (memory == MAP_FAILED) return false;
  mapped_ = memory;
  mapped_bytes_ = bytes;
  return true;
}

void WorkerProcess::unmap_film() {
  if (mapped_) ::munmap(std::exchange(mapped_, nullptr), mapped_bytes_);
}

void WorkerProcess::release_film() {
  unmap_film();
  (void)clear(film_);
}

bool WorkerProcess::write_film(std::uint64_t offset, const void* from, std::size_t bytes) {
  const auto* next = static_cast<const char*>(from);
  while (bytes > 0) {
    const ssize_t written = ::pwrite(film_, next, bytes, static_cast<off_t>(offset));
    if (written < 0 && errno == EINTR) continue;
    if (written <= 0) return false;
    next += written;
    offset += static_cast<std::uint64_t>(written);
    bytes -= static_cast<std::size_t>(written);
  }
  return true;
}

void WorkerProcess::kill(std::string reason) {
  // What it did explains more than how it ended, even where it was quicker to end by itself.
  if (kill_reason_.empty()) kill_reason_ = std::move(reason);
  if (!status_) ::kill(pid_, SIGKILL);
}

void WorkerProcess::abandon() {
  handlers_ = {};
  if (!status_) {
    ::kill(pid_, SIGKILL);
    int status = 0;
    ::waitpid(pid_, &status, 0);
    status_ = status;
  }
  boost::system::error_code ignored;
  exit_.close(ignored);
  grace_.cancel();
  channel_.close();
  unsent_signal_.cancel();
}

}  // namespace metamer::service
