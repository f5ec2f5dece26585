#include "server/service/executors/slurm/command.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "common/wire/worker_exit.h"
#include "server/service/executors/kept_environment.h"

namespace metamer::service {
namespace {

/// A pipe whose ends are closed with it; neither is a descriptor that a child is given.
struct Pipe {
  int read = -1;
  int write = -1;
  bool open() {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) return false;
    read = ::fcntl(ends[0], F_DUPFD_CLOEXEC, 10);
    write = ::fcntl(ends[1], F_DUPFD_CLOEXEC, 10);
    ::close(ends[0]);
    ::close(ends[1]);
    return read >= 0 && write >= 0;
  }
  static void close(int& end) {
    if (end >= 0) ::close(std::exchange(end, -1));
  }
  ~Pipe() {
    close(read);
    close(write);
  }
};

/// What finds Slurm's programs and its controller; Slurm would hand the rest on to tasks.
std::vector<char*> command_environment() {
  constexpr std::string_view kept[] = {
      "PATH=",  "HOME=", "USER=",        "LOGNAME=", "LANG=", "SLURM_", "LD_LIBRARY_PATH=",
      "MUNGE_", "TZ=",   "METAMER_TEST_"};
  return kept_environment(kept);
}

int spawn_command(std::vector<std::string> words, const Pipe& in, const Pipe& out, const Pipe& err,
                  pid_t& pid) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  std::vector<char*> environment = command_environment();
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, in.read, STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&actions, out.write, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, err.write, STDERR_FILENO);
  posix_spawn_file_actions_addclosefrom_np(&actions, STDERR_FILENO + 1);
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t none, all;
  sigemptyset(&none);
  sigfillset(&all);
  posix_spawnattr_setsigmask(&attributes, &none);
  posix_spawnattr_setsigdefault(&attributes, &all);
  posix_spawnattr_setflags(&attributes,
                           static_cast<short>(POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF));
  const int error = ::posix_spawnp(&pid, arguments[0], &actions, &attributes, arguments.data(),
                                   environment.data());
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  return error;
}

/// Reads both to their ends. Empty: done; else why not.
std::string read_both(Pipe& out, Pipe& err, std::array<std::string, 2>& said,
                      const CommandLimits& limits, const std::atomic<bool>& cancelled) {
  const auto end = std::chrono::steady_clock::now() + limits.time;
  std::array<int*, 2> ends{&out.read, &err.read};
  std::array<char, 64 << 10> piece;
  while (out.read >= 0 || err.read >= 0) {
    if (cancelled) return "was ended with the server";
    if (std::chrono::steady_clock::now() >= end)
      return "did not end within " + std::to_string(limits.time.count()) + " ms";
    std::array<pollfd, 2> waiting{{{out.read, POLLIN, 0}, {err.read, POLLIN, 0}}};
    if (::poll(waiting.data(), waiting.size(), 50) < 0 && errno != EINTR)
      return std::strerror(errno);
    for (std::size_t i = 0; i < 2; ++i) {
      if (*ends[i] < 0 || waiting[i].revents == 0) continue;
      const ssize_t got = ::read(*ends[i], piece.data(), piece.size());
      if (got <= 0) {
        Pipe::close(*ends[i]);
        continue;
      }
      said[i].append(piece.data(), static_cast<std::size_t>(got));
      if (said[0].size() + said[1].size() > limits.bytes) return "said too much";
    }
  }
  return {};
}

/// The first line of what a program said, printable and short.
std::string first_line_of(const std::string& text) {
  std::string line = text.substr(0, std::min<std::size_t>(text.find('\n'), 200));
  for (char& c : line)
    if (static_cast<unsigned char>(c) < ' ' || c == '\x7f') c = '?';
  return line;
}

}  // namespace

Result<std::string> run_command(const std::vector<std::string>& words, std::string_view input,
                                const CommandLimits& limits, const std::atomic<bool>& cancelled) {
  Pipe in, out, err;
  if (!in.open() || !out.open() || !err.open())
    return problem(words[0] + ": " + std::strerror(errno));
  // Before there is a reader, who may end without reading: no signal of a broken pipe can come.
  if (::fcntl(in.write, F_SETFL, O_NONBLOCK) != 0 ||
      ::write(in.write, input.data(), input.size()) != static_cast<ssize_t>(input.size()))
    return problem(words[0] + ": more input than a pipe holds");
  pid_t pid = -1;
  if (const int error = spawn_command(words, in, out, err, pid); error != 0)
    return problem("can't start " + words[0] + ": " + std::strerror(error));
  Pipe::close(in.write);
  Pipe::close(in.read);
  Pipe::close(out.write);
  Pipe::close(err.write);

  std::array<std::string, 2> said;
  const std::string broken = read_both(out, err, said, limits, cancelled);
  if (!broken.empty()) ::kill(pid, SIGKILL);
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0 && errno == EINTR) continue;
  if (!broken.empty()) return problem(words[0] + " " + broken);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
    const std::string line = first_line_of(said[1]);
    return problem(words[0] + " " + (line.empty() ? wire::describe_exit(status) : "says: " + line));
  }
  return std::move(said[0]);
}

}  // namespace metamer::service
