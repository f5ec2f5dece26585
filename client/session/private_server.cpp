#include "client/session/private_server.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

extern "C" {  // glibc 2.36 forgot it
#include <sys/pidfd.h>
}

#include <array>
#include <boost/asio.hpp>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace metamer::client {
namespace {

namespace asio = boost::asio;
namespace fs = std::filesystem;

constexpr int daemon_fd = 3;  // in the daemon: its end of the pair

tl::unexpected<SessionError> no_server(std::string message) {
  return session_error(SessionError::Kind::no_server, std::move(message));
}

/// The daemon beside our own program; its bare name, to be found in PATH, when there is none.
std::string find_daemon() {
  std::error_code error;
  const fs::path self = fs::read_symlink("/proc/self/exe", error);
  const fs::path beside = self.parent_path() / "metamerd";
  return !error && access(beside.c_str(), X_OK) == 0 ? beside.string() : "metamerd";
}

/// A folder that only we can enter. Its path is short: a Unix socket's is limited to 107 bytes.
Answer<fs::path> make_folder() {
  const char* base = std::getenv("XDG_RUNTIME_DIR");
  if (base == nullptr || access(base, W_OK | X_OK) != 0 || std::strlen(base) > 60) base = "/tmp";
  std::string pattern = std::string(base) + "/metamer-XXXXXX";
  if (mkdtemp(pattern.data()) == nullptr)
    return no_server("cannot make a folder for a socket in " + std::string(base) + ": " +
                     std::strerror(errno));
  return fs::path(pattern);
}

/// Starts the daemon in a process group of its own, so that a Ctrl-C at the terminal is ours
/// alone; its log goes into the folder. Returns its pid.
Answer<pid_t> spawn_daemon(const std::string& daemon, const fs::path& folder, int pair_end) {
  const std::string listen = "unix:" + (folder / "socket").string();
  const std::string log = (folder / "log").string();
  std::vector<std::string> words = {
      daemon, "--listen", listen, "--parent-fd", std::to_string(daemon_fd), "--log-level", "warn",
      // One person's own server renders their own files: on an old kernel, too.
      "--unconfined"};
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
  posix_spawn_file_actions_adddup2(&actions, 1, 2);
  posix_spawn_file_actions_adddup2(&actions, pair_end, daemon_fd);

  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none;
  sigemptyset(&none);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setpgroup(&attributes, 0);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETPGROUP);

  pid_t pid = -1;
  const int error = posix_spawnp(&pid, daemon.c_str(), &actions, &attributes, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  posix_spawnattr_destroy(&attributes);
  if (error != 0) return no_server("cannot start " + daemon + ": " + std::strerror(error));
  return pid;
}

/// Waits for the line `ready`. `descriptor` stays the caller's.
asio::awaitable<bool> wait_for_ready(int descriptor) {
  const auto executor = co_await asio::this_coro::executor;
  const auto socket = std::make_shared<asio::local::stream_protocol::socket>(
      executor, asio::local::stream_protocol(), dup(descriptor));
  asio::steady_timer limit(executor, PrivateServer::start_time_limit);
  limit.async_wait([socket](const boost::system::error_code& error) {
    if (!error) socket->cancel();
  });
  constexpr std::size_t max_line = 64;
  std::string line;
  boost::system::error_code error;
  co_await asio::async_read_until(*socket, asio::dynamic_buffer(line, max_line), '\n',
                                  asio::redirect_error(asio::use_awaitable, error));
  limit.cancel();
  co_return !error && line == "ready\n";
}

}  // namespace

asio::awaitable<Answer<PrivateServer>> PrivateServer::start(int nice) {
  PrivateServer server;

  // Make the pair by which the daemon notices our end; only its own end is inherited.
  std::array<int, 2> pair{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair.data()) != 0)
    co_return no_server(std::string("cannot make a socket pair: ") + std::strerror(errno));
  server.pair_end_ = pair[0];

  // Start it.
  Answer<fs::path> folder = make_folder();
  if (!folder) {
    close(pair[1]);
    co_return tl::unexpected<SessionError>(std::move(folder.error()));
  }
  server.folder_ = *folder;
  const std::string daemon = find_daemon();
  Answer<pid_t> pid = spawn_daemon(daemon, server.folder_, pair[1]);
  close(pair[1]);
  if (!pid) co_return tl::unexpected<SessionError>(std::move(pid.error()));
  server.pid_ = *pid;
  // Its workers and threads come after this; without it all works, too.
  if (nice != 0) setpriority(PRIO_PROCESS, static_cast<id_t>(*pid), nice);

  // Wait until it listens.
  const bool ready = co_await wait_for_ready(server.pair_end_);
  if (!ready) co_return no_server("the private " + daemon + " did not start" + server.last_words());
  co_return Answer<PrivateServer>(std::move(server));
}

PrivateServer::PrivateServer(PrivateServer&& other) noexcept
    : pid_(std::exchange(other.pid_, -1)),
      pair_end_(std::exchange(other.pair_end_, -1)),
      folder_(std::exchange(other.folder_, {})),
      log_(std::move(other.log_)) {}

PrivateServer::~PrivateServer() {
  if (pair_end_ >= 0) close(pair_end_);
  if (pid_ > 0) {
    const int process = pidfd_open(pid_, 0);
    pollfd ended{process, POLLIN, 0};
    const auto limit = std::chrono::duration_cast<std::chrono::milliseconds>(stop_time_limit);
    if (process < 0 || poll(&ended, 1, static_cast<int>(limit.count())) != 1) kill(pid_, SIGKILL);
    if (process >= 0) close(process);
    waitpid(pid_, nullptr, 0);
  }
  connected();
}

void PrivateServer::connected() {
  if (folder_.empty()) return;
  log_.open(folder_ / "log");
  std::error_code ignored;  // a folder that is gone already is as good
  fs::remove_all(folder_, ignored);
  folder_.clear();
}

std::string PrivateServer::how_it_ended() {
  constexpr std::chrono::milliseconds moment{200};  // its socket closes before it is gone
  if (pid_ <= 0) return {};
  const int process = pidfd_open(pid_, 0);
  pollfd ended{process, POLLIN, 0};
  const bool gone = process >= 0 && poll(&ended, 1, static_cast<int>(moment.count())) == 1;
  if (process >= 0) close(process);
  int status = 0;
  if (!gone || waitpid(pid_, &status, WNOHANG) != pid_) return {};
  pid_ = -1;
  return "the private metamerd ended " +
         (WIFSIGNALED(status) ? "by signal " + std::to_string(WTERMSIG(status))
                              : "with code " + std::to_string(WEXITSTATUS(status))) +
         last_words();
}

std::string PrivateServer::last_words() {
  if (!log_.is_open()) log_.open(folder_ / "log");
  std::string line, last;
  while (std::getline(log_, line))
    if (!line.empty()) last = line;
  return last.empty() ? std::string() : ": " + last;
}

}  // namespace metamer::client
