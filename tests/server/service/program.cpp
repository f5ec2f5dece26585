#include "program.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <sstream>
#include <thread>

namespace metamer::service::test {

Program::Program(const std::filesystem::path& folder, std::vector<std::string> options,
                 std::vector<std::string> environment)
    : log_(folder / "log") {
  std::vector<std::string> words = {METAMER_BIN "/metamerd", "--worker",
                                    METAMER_BIN "/metamer-fake-worker"};
  words.insert(words.end(), options.begin(), options.end());
  environment.push_back("TMPDIR=" + folder.string());
  // A library that is preloaded stands before the sanitizer's.
  environment.push_back("ASAN_OPTIONS=verify_asan_link_order=0");
  const auto pointers = [](std::vector<std::string>& texts) {
    std::vector<char*> all;
    for (std::string& text : texts) all.push_back(text.data());
    all.push_back(nullptr);
    return all;
  };

  int pair[2];
  EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair), 0);
  pair_end_ = ::fcntl(pair[0], F_DUPFD_CLOEXEC, 10);
  const int theirs = ::fcntl(pair[1], F_DUPFD_CLOEXEC, 10);
  ::close(pair[0]);
  ::close(pair[1]);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 2, log_.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
  posix_spawn_file_actions_adddup2(&actions, theirs, 3);
  EXPECT_EQ(posix_spawn(&pid_, words[0].c_str(), &actions, nullptr, pointers(words).data(),
                        pointers(environment).data()),
            0);
  posix_spawn_file_actions_destroy(&actions);
  ::close(theirs);
}

Program::~Program() {
  hang_up();
  if (pid_ > 0) wait();
}

std::string Program::ready() {
  char line[16];
  const ssize_t got = ::recv(pair_end_, line, sizeof line, 0);
  return got > 0 ? std::string(line, static_cast<std::size_t>(got)) : "";
}

void Program::hang_up() {
  if (pair_end_ >= 0) ::close(pair_end_);
  pair_end_ = -1;
}

long Program::faults() const {
  std::ifstream file("/proc/" + std::to_string(pid_) + "/stat");
  std::string text{std::istreambuf_iterator<char>(file), {}};
  std::istringstream fields(text.substr(text.rfind(')') + 2));
  std::string skipped;
  for (int i = 3; i < 10; ++i) fields >> skipped;  // minflt is the tenth, see proc(5)
  long faults = 0;
  fields >> faults;
  return faults;
}

void Program::signal(int number) { ::kill(pid_, number); }

int Program::wait() {
  int status = 0;
  ::waitpid(pid_, &status, 0);
  pid_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}

bool Program::says(const std::string& text) const {
  for (int tries = 0; tries < 1000; ++tries) {
    if (log().find(text) != std::string::npos) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

std::string Program::log() const {
  std::ifstream file(log_);
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace metamer::service::test
