#include "process.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

extern "C" {  // glibc 2.36 forgot it
#include <sys/pidfd.h>
}

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <set>
#include <stdexcept>
#include <utility>

namespace metamer::test {
namespace {

namespace fs = std::filesystem;

constexpr int line_limit_ms = 30'000;
constexpr int end_limit_ms = 60'000;

std::vector<char*> pointers(std::vector<std::string>& words) {
  std::vector<char*> result;
  for (std::string& word : words) result.push_back(word.data());
  result.push_back(nullptr);
  return result;
}

std::vector<std::string> environment_with(const std::map<std::string, std::string>& added) {
  std::vector<std::string> result;
  for (char** entry = environ; *entry; ++entry) {
    const std::string text = *entry;
    const std::string name = text.substr(0, text.find('='));
    // A server of the person who runs the tests is none of theirs.
    if (added.count(name) == 0 && name != "METAMER_SERVER") result.push_back(text);
  }
  for (const auto& [name, value] : added) result.push_back(name + "=" + value);
  return result;
}

std::string first_line(const fs::path& file) {
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line, '\n');
  std::replace(line.begin(), line.end(), '\0', ' ');
  return line;
}

/// Who else holds the pipe of descriptor `fd` open, and what each of their threads waits for: all
/// that there is to know of a test that hung on another machine.
std::string holders(int fd) {
  std::error_code ignored;
  const fs::path pipe = fs::read_symlink("/proc/self/fd/" + std::to_string(fd), ignored);
  std::string text;
  for (const auto& process : fs::directory_iterator("/proc", ignored)) {
    bool holds = false;
    for (const auto& one : fs::directory_iterator(process.path() / "fd", ignored))
      holds |= fs::read_symlink(one.path(), ignored) == pipe;
    if (!holds || process.path().filename() == std::to_string(getpid())) continue;
    text +=
        process.path().filename().string() + " " + first_line(process.path() / "cmdline") + "\n";
    for (const auto& thread : fs::directory_iterator(process.path() / "task", ignored))
      text += "  " + first_line(thread.path() / "stat").substr(0, 60) + " in " +
              first_line(thread.path() / "wchan") + ", system call " +
              first_line(thread.path() / "syscall") + "\n";
  }
  return text;
}

std::array<int, 2> make_pipe() {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error("no pipe");
  return ends;
}

}  // namespace

Process::Process(std::vector<std::string> words, const ProcessOptions& options) {
  if (words[0].find('/') == std::string::npos) words[0] = METAMER_BIN "/" + words[0];
  const auto out = make_pipe();
  const auto err = make_pipe();

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, out[1], 1);
  posix_spawn_file_actions_adddup2(&actions, err[1], 2);
  if (options.parent_fd >= 0) posix_spawn_file_actions_adddup2(&actions, options.parent_fd, 3);
  if (!options.folder.empty())
    posix_spawn_file_actions_addchdir_np(&actions, options.folder.c_str());

  std::vector<std::string> environment = environment_with(options.environment);
  const int error = posix_spawn(&pid_, words[0].c_str(), &actions, nullptr, pointers(words).data(),
                                pointers(environment).data());
  posix_spawn_file_actions_destroy(&actions);
  close(out[1]);
  close(err[1]);
  out_.fd = out[0];
  err_.fd = err[0];
  if (error != 0) throw std::runtime_error("cannot start " + words[0]);
}

Process::~Process() {
  if (pid_ > 0) {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  if (out_.fd >= 0) close(out_.fd);
  if (err_.fd >= 0) close(err_.fd);
}

void Process::signal(int number) const { kill(pid_, number); }

bool Process::read_some(int time_limit_ms) {
  std::array<pollfd, 2> polled = {{{out_.fd, POLLIN, 0}, {err_.fd, POLLIN, 0}}};
  if (out_.fd < 0 && err_.fd < 0) return false;
  if (poll(polled.data(), polled.size(), time_limit_ms) <= 0) return false;
  for (auto [pipe, state] : {std::pair{&out_, &polled[0]}, std::pair{&err_, &polled[1]}}) {
    if (pipe->fd < 0 || state->revents == 0) continue;
    std::array<char, 65536> bytes{};
    const ssize_t count = read(pipe->fd, bytes.data(), bytes.size());
    if (count > 0) {
      pipe->text.append(bytes.data(), static_cast<std::size_t>(count));
    } else {
      close(std::exchange(pipe->fd, -1));
    }
  }
  return true;
}

std::optional<std::string> Process::line(Pipe& pipe, const std::string& text) {
  while (true) {
    for (std::size_t end; (end = pipe.text.find('\n', pipe.told)) != std::string::npos;) {
      const std::string found = pipe.text.substr(pipe.told, end - pipe.told);
      pipe.told = end + 1;
      if (found.find(text) != std::string::npos) return found;
    }
    if (pipe.fd < 0 || !read_some(line_limit_ms)) return std::nullopt;
  }
}

std::optional<std::string> Process::line_out(const std::string& text) { return line(out_, text); }
std::optional<std::string> Process::line_err(const std::string& text) { return line(err_, text); }

Ended Process::wait() {
  while (out_.fd >= 0 || err_.fd >= 0) {
    if (read_some(end_limit_ms)) continue;
    ADD_FAILURE() << "killed after a minute of silence; its output is held open by\n"
                  << holders(out_.fd >= 0 ? out_.fd : err_.fd) << "it had said:\n"
                  << out_.text << err_.text;
    kill(pid_, SIGKILL);
    break;
  }
  int status = 0;
  waitpid(std::exchange(pid_, -1), &status, 0);
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return {code, out_.text, err_.text};
}

Ended run(std::vector<std::string> words, const ProcessOptions& options) {
  Process process(std::move(words), options);
  return process.wait();
}

Ended metamer(std::vector<std::string> words, const ProcessOptions& options) {
  words.insert(words.begin(), "metamer");
  return run(std::move(words), options);
}

void expect_refused(const std::vector<std::string>& words, const std::string& message) {
  const Ended ended = metamer(words);
  EXPECT_EQ(ended.code, 2) << message;
  EXPECT_NE(ended.err.find(message), std::string::npos) << ended.err;
}

OtherProcess::OtherProcess(pid_t pid) : fd_(pidfd_open(pid, 0)) {}

OtherProcess::~OtherProcess() {
  if (fd_ >= 0) close(fd_);
}

bool OtherProcess::ends() const {
  pollfd polled{fd_, POLLIN, 0};
  return fd_ >= 0 && poll(&polled, 1, 10'000) == 1;
}

std::vector<pid_t> children_of(pid_t pid) {
  // A child is listed under the thread that started it.
  std::set<pid_t> children;
  for (const auto& thread : fs::directory_iterator("/proc/" + std::to_string(pid) + "/task")) {
    std::ifstream list(thread.path() / "children");
    for (pid_t child = 0; list >> child;) children.insert(child);
  }
  return {children.begin(), children.end()};
}

Folder::Folder() {
  std::string pattern = (fs::temp_directory_path() / "metamer-test-XXXXXX").string();
  if (!mkdtemp(pattern.data())) throw std::runtime_error("no folder");
  path_ = pattern;
}

Folder::~Folder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

std::string Folder::write(const std::string& name, const std::string& text) const {
  const fs::path path = fs::path(path_) / name;
  fs::create_directories(path.parent_path());
  std::ofstream(path, std::ios::binary) << text;
  return path.string();
}

}  // namespace metamer::test
