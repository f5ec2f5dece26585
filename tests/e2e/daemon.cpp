#include "daemon.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>

namespace metamer::test {
namespace {

/// A TCP port of the loopback that nobody listens on just now.
std::uint16_t free_port() {
  const int probe = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  bind(probe, reinterpret_cast<sockaddr*>(&address), size);
  getsockname(probe, reinterpret_cast<sockaddr*>(&address), &size);
  close(probe);
  return ntohs(address.sin_port);
}

std::vector<std::string> joined(std::vector<std::string> first,
                                const std::vector<std::string>& second) {
  first.insert(first.end(), second.begin(), second.end());
  return first;
}

}  // namespace

Daemon::Daemon(Listens listens, std::vector<std::string> options) {
  if (listens == Listens::tcp) {
    port_ = free_port();
    address_ = "127.0.0.1:" + std::to_string(port_);
  } else {
    socket_path_ = folder_ / "socket";
    address_ = "unix:" + socket_path_;
  }
  std::array<int, 2> pair{};
  if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, pair.data()) != 0)
    throw std::runtime_error("no socket pair");
  pair_end_ = pair[0];
  ProcessOptions how;
  how.parent_fd = pair[1];
  how.environment["TMPDIR"] = folder_.path();
  if (std::find(options.begin(), options.end(), "--threads") == options.end())
    options.insert(options.end(), {"--threads", "1"});
  // Little is logged: nobody reads the pipe before the end.
  process_ = std::make_unique<Process>(
      joined({"metamerd", "--listen", address_, "--open", "--parent-fd", "3", "--log-level",
              "error", "--first-job", "1", "--unconfined"},
             options),
      how);
  close(pair[1]);

  std::array<char, 6> ready{};
  if (recv(pair_end_, ready.data(), ready.size(), MSG_WAITALL) != 6)
    throw std::runtime_error("metamerd did not start: " + process_->wait().err);
}

Daemon::~Daemon() {
  // An orderly end takes the daemon's folders and its worker along.
  close(pair_end_);
  process_->signal(SIGCONT);
  process_->wait();
}

Ended Daemon::metamer(std::vector<std::string> words) const {
  return test::metamer(joined(std::move(words), {"--server", address_}));
}

std::unique_ptr<Process> Daemon::start(std::vector<std::string> words) const {
  return std::make_unique<Process>(joined(joined({"metamer"}, words), {"--server", address_}));
}

Json Daemon::json(std::vector<std::string> words) const {
  return parse_document(metamer(joined(std::move(words), {"--json"})).out);
}

std::string Daemon::submit(const std::string& scene, std::vector<std::string> overrides) const {
  const Ended ended = metamer(joined({"submit", scene}, overrides));
  EXPECT_EQ(ended.code, 0) << ended.err;
  return ended.out.substr(0, ended.out.find('\n'));
}

pid_t Daemon::worker_pid() const { return json({"info"})["info"]["worker"][0]["pid"]; }
pid_t Daemon::views_worker_pid() const { return json({"info"})["info"]["worker"][2]["pid"]; }

std::string Daemon::job_state(const std::string& job) const {
  const Json answer = json({"jobs"});
  for (const Json& one : answer["jobs"])
    if (std::to_string(one["job_id"].get<std::uint64_t>()) == job) return one["state"];
  return "unknown";
}

HeldWorkers::HeldWorkers(const Daemon& daemon) : HeldWorkers(children_of(daemon.pid())) {}

HeldWorkers::HeldWorkers(std::vector<pid_t> pids) : pids_(std::move(pids)) {
  EXPECT_FALSE(pids_.empty());
  for (const pid_t pid : pids_) kill(pid, SIGSTOP);
}

void HeldWorkers::release() {
  for (const pid_t pid : pids_) kill(pid, SIGCONT);
  pids_.clear();
}

Json parse_document(const std::string& text) {
  Json document = Json::parse(text, nullptr, false);
  EXPECT_FALSE(document.is_discarded()) << "not one JSON document:\n" << text;
  return document;
}

}  // namespace metamer::test
