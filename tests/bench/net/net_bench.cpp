// What bad neighbours cost: net_bench [SECONDS]. Prints the rate at which four clients are answered
// beside peers that do not read, stop in mid-frame or send a byte at a time, as a ratio to the rate
// without these.
#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <thread>
#include <vector>

#include "../../server/service/client.h"
#include "../../server/service/program.h"
#include "../../server/service/temporary_state.h"

namespace {

using namespace metamer;
using namespace metamer::service::test;
using Clock = std::chrono::steady_clock;
using Clients = std::vector<std::unique_ptr<Client>>;

constexpr int fast_clients = 4;
constexpr int bad_of_each_sort = 40;

/// Answers a second, of all fast clients together, each of which asks after its last answer.
double rate(const std::string& socket, std::chrono::duration<double> time) {
  std::atomic<long> answers = 0;
  std::vector<std::jthread> threads;
  const auto start = Clock::now();
  for (int i = 0; i < fast_clients; ++i)
    threads.emplace_back([&] {
      Client client(socket);
      client.hello();
      v1::Envelope ping;
      ping.mutable_ping();
      for (; Clock::now() - start < time; ++answers)
        if (!client.ask(ping).has_pong()) std::abort();
    });
  threads.clear();
  return static_cast<double>(answers) / std::chrono::duration<double>(Clock::now() - start).count();
}

Clients enter(const std::string& socket) {
  Clients clients;
  for (int i = 0; i < bad_of_each_sort; ++i) {
    clients.push_back(std::make_unique<Client>(socket));
    clients.back()->hello();
  }
  return clients;
}

std::string half_frame() {
  v1::Envelope ping;
  ping.mutable_hello()->set_client(std::string(1000, 'x'));
  const std::string frame = wire::encode_frame(ping.SerializeAsString());
  return frame.substr(0, frame.size() / 2);
}

}  // namespace

int main(int argc, char** argv) {
  const std::chrono::duration<double> time(argc > 1 ? std::atof(argv[1]) : 2);
  const TemporaryState place;
  const std::string socket = (place.path() / "socket").string();
  Program daemon(place.path(), {"--listen", "unix:" + socket, "--parent-fd", "3", "--log-level",
                                "off", "--sessions", "500", "--live-jobs", "500"});
  if (daemon.ready() != "ready\n") std::abort();

  Clients deaf = enter(socket), stopped = enter(socket), slow = enter(socket);
  // Whoever asks for 12 MB and reads none of them.
  Client author(socket);
  author.hello();
  const std::uint64_t job = author.submit("picture 1000 1000 64");
  author.watch(job, 0, false);
  author.receive_event_until([](const v1::JobEvent& event) { return event.has_finished(); });
  double alone = 0, beside = 0;
  for (int turn = 0; turn < 3; ++turn) alone = std::max(alone, rate(socket, time));

  for (const auto& client : deaf) client->watch(job);
  for (const auto& client : stopped) client->send_bytes(half_frame());
  std::jthread drip([&](const std::stop_token& end) {
    const std::string frame = wire::encode_frame(std::string(100'000, '\0'));
    for (std::size_t at = 0; !end.stop_requested() && at < frame.size(); ++at) {
      for (const auto& client : slow) client->send_bytes(frame.substr(at, 1));
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  });
  for (int turn = 0; turn < 3; ++turn) beside = std::max(beside, rate(socket, time));
  std::printf(
      "answers a second of %d clients: %.0f alone, %.0f beside %d that do not read, %d that stop "
      "in "
      "mid-frame and %d that send 100 bytes a second: ratio %.2f\n",
      fast_clients, alone, beside, bad_of_each_sort, bad_of_each_sort, bad_of_each_sort,
      beside / alone);
}
