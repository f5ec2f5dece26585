// What sessions cost that are there and silent: the figure that limits.h and PROTOCOL.md give.

#include <gtest/gtest.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iostream>

#include "../../../common/wire/certificates.h"
#include "../temporary_state.h"
#include "common/wire/channel.h"
#include "common/wire/tls.h"
#include "metamer/v1/envelope.pb.h"
#include "server/service/access/users.h"
#include "server/service/ops/folders.h"
#include "server/service/store/schema.h"

namespace metamer::service::test {

namespace {

namespace asio = boost::asio;

/// A metamerd with the fake worker in a process of its own, whose memory is its alone.
class OwnDaemon {
 public:
  OwnDaemon(const TemporaryState& state, const wire::TlsIdentity& identity)
      : log_(state.path() / "log") {
    std::vector<std::string> words = {METAMER_BIN "/metamerd",
                                      "--worker",
                                      METAMER_BIN "/metamer-fake-worker",
                                      "--listen",
                                      "tls:127.0.0.1:0",
                                      "--state",
                                      state.path(),
                                      "--tls-cert",
                                      identity.certificate,
                                      "--tls-key",
                                      identity.key,
                                      "--unconfined"};
    std::vector<char*> arguments;
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_addopen(&actions, 2, log_.c_str(), O_WRONLY | O_CREAT, 0600);
    EXPECT_EQ(posix_spawn(&pid_, arguments[0], &actions, nullptr, arguments.data(), environ), 0);
    posix_spawn_file_actions_destroy(&actions);
  }
  ~OwnDaemon() {
    ::kill(pid_, SIGTERM);
    ::waitpid(pid_, nullptr, 0);
  }
  OwnDaemon(const OwnDaemon&) = delete;

  /// Where it listens, as its log says; waits for that.
  wire::Endpoint endpoint() const {
    for (int tries = 0; tries < 1000; ++tries) {
      std::ifstream file(log_);
      const std::string text{std::istreambuf_iterator<char>(file), {}};
      const auto at = text.find("listening on tls:");
      const auto end = at == std::string::npos ? at : text.find('\n', at);
      if (end != std::string::npos)
        return wire::parse_endpoint(text.substr(at + 13, end - at - 13)).value();
      ::usleep(20'000);
    }
    throw std::runtime_error("metamerd does not listen");
  }
  /// Of its own pages, in bytes.
  double memory() const {
    std::ifstream file("/proc/" + std::to_string(pid_) + "/status");
    std::string word;
    double kib = 0;
    while (file >> word)
      if (word == "RssAnon:") file >> kib;
    return kib * 1024;
  }

 private:
  std::filesystem::path log_;
  pid_t pid_ = -1;
};

/// Clients that have said Hello and wait.
class Crowd {
 public:
  Crowd(wire::Endpoint endpoint, wire::TlsContext trust, std::string token)
      : endpoint_(std::move(endpoint)), trust_(std::move(trust)), token_(std::move(token)) {}

  /// Some at a time, as the door has room for one source's.
  void grow(std::size_t count) {
    constexpr std::size_t at_once = 32;
    while (channels_.size() < count) {
      const std::size_t wanted = std::min(count, channels_.size() + at_once);
      for (std::size_t i = channels_.size(); i < wanted; ++i)
        asio::co_spawn(loop_, enter(), asio::detached);
      loop_.run();
      loop_.restart();
      if (channels_.size() < wanted) throw std::runtime_error("a client was not let in");
    }
  }

  /// Seconds that an answer takes, of each client in turn.
  std::vector<double> ping_all() {
    std::vector<double> seconds;
    asio::co_spawn(
        loop_,
        [&]() -> asio::awaitable<void> {
          for (const auto& channel : channels_) {
            const auto begin = std::chrono::steady_clock::now();
            v1::Envelope ping, pong;
            ping.mutable_ping();
            (void)co_await channel->write(ping);
            (void)co_await channel->read(pong);
            if (!pong.has_pong()) throw std::runtime_error("no pong");
            seconds.push_back(
                std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
          }
        },
        [](const std::exception_ptr& error) {
          if (error) std::rethrow_exception(error);
        });
    loop_.run();
    loop_.restart();
    return seconds;
  }

 private:
  asio::awaitable<void> enter() {
    auto socket = co_await wire::connect(endpoint_);
    if (!socket) co_return;
    auto stream = co_await wire::connect_tls(std::move(*socket), trust_, endpoint_.host);
    if (!stream) co_return;
    auto channel = std::make_unique<wire::Channel>(*std::move(stream), wire::Peer::server);
    v1::Envelope hello, welcome;
    hello.mutable_hello()->set_protocol_version(1);
    hello.mutable_hello()->set_token(token_);
    (void)co_await channel->write(hello);
    (void)co_await channel->read(welcome);
    if (welcome.has_welcome()) channels_.push_back(std::move(channel));
  }

  wire::Endpoint endpoint_;
  wire::TlsContext trust_;
  std::string token_;
  asio::io_context loop_;
  std::vector<std::unique_ptr<wire::Channel>> channels_;
};

}  // namespace

// With the allocator that is delivered: sanitizers bring their own.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(IdleSessions, AThousandByTlsTakeLessThan100MiB) {
  allow_descriptors();
  const TemporaryState state;
  wire::test::Certificates certificates;
  const OwnDaemon daemon(state, certificates.sign("server", "IP:127.0.0.1"));
  const wire::Endpoint endpoint = daemon.endpoint();
  Database database(state.database());
  Users users(database);
  const auto trust = wire::TlsContext::client({certificates.authority(), {}}).value();
  // Of one user it would be 7/8 of all; the rest is another's.
  std::vector<std::unique_ptr<Crowd>> crowds;
  for (const char* name : {"ann", "bob"}) {
    UserChange change;
    change.name = name;
    change.role = v1::SUBMITTER;
    ASSERT_TRUE(users.add(change, 0));
    crowds.push_back(
        std::make_unique<Crowd>(endpoint, trust, users.add_token(name, "desk", std::nullopt, 0)));
  }
  crowds[0]->grow(1);
  const double before = daemon.memory();
  crowds[0]->grow(875);
  crowds[1]->grow(109);
  crowds[1]->ping_all();
  const double taken = daemon.memory() - before;
  auto seconds = crowds[0]->ping_all();
  std::sort(seconds.begin(), seconds.end());
  constexpr double mib = 1 << 20;
  std::cout << "984 idle TLS sessions: " << taken / mib << " MiB, " << taken / 983 / 1024
            << " KiB each; ping: median " << seconds[seconds.size() / 2] * 1e3 << " ms, p99 "
            << seconds[seconds.size() * 99 / 100] * 1e3 << " ms\n";
  EXPECT_LT(taken, 984.0 / 1000 * 100 * mib);
}
#endif

}  // namespace metamer::service::test
