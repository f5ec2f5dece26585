// What it costs to keep jobs: state_bench [JOBS]. Prints ratios of a daemon with a state to one
// without, whose worker does nothing.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "../../server/service/client.h"
#include "../../server/service/program.h"
#include "../../server/service/temporary_state.h"

namespace {

using namespace metamer;
using namespace metamer::service::test;
using Clock = std::chrono::steady_clock;

double since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

struct Figures {
  double alone = 0;  // submits a second, one client after each answer
  double many = 0;   // the same with 64 clients at a time
  double bytes = 0;  // a second, of a finished picture of 3840 × 2160 in tiles of 256
};

/// So many submits by so many clients, each after the answer to its last one; submits a second.
double submits(const std::string& socket, int clients, int jobs) {
  std::vector<std::jthread> threads;
  const auto start = Clock::now();
  for (int i = 0; i < clients; ++i)
    threads.emplace_back([&] {
      Client client(socket);
      client.hello();
      v1::Envelope message;
      message.mutable_submit()->set_scene_sha256(client.upload({"picture 8 8 8"})[0]);
      message.mutable_submit()->set_check_only(true);
      for (int job = 0; job < jobs / clients; ++job)
        if (!client.ask(message).has_submitted()) std::abort();
    });
  threads.clear();
  return jobs / since(start);
}

double stream(const std::string& socket) {
  Client client(socket);
  client.hello();
  const std::uint64_t job = client.submit("picture 3840 2160 256");
  client.watch(job, 0, false);
  client.receive_event_until([](const v1::JobEvent& event) { return event.has_finished(); });
  double bytes = 0;
  const auto start = Clock::now();
  client.watch(job);
  client.receive_event_until([&](const v1::JobEvent& event) {
    bytes += static_cast<double>(event.tile().xyz().size());
    return event.has_finished();
  });
  return bytes / since(start);
}

Figures measure(const std::string& state, int jobs) {
  const TemporaryState place;
  const std::string socket = (place.path() / "socket").string();
  std::vector<std::string> options = {
      "--listen", "unix:" + socket, "--parent-fd", "3",           "--live-jobs",
      "100000",   "--sessions",     "200",         "--log-level", "off"};
  if (!state.empty()) options.insert(options.end(), {"--state", state});
  Program daemon(place.path(), options);
  if (daemon.ready() != "ready\n") std::abort();
  Figures figures;
  figures.bytes = stream(socket);
  figures.alone = submits(socket, 1, jobs / 8);
  figures.many = submits(socket, 64, jobs);
  return figures;
}

}  // namespace

int main(int argc, char** argv) {
  const int jobs = argc > 1 ? std::atoi(argv[1]) : 3200;
  Figures kept, forgotten;
  for (int turn = 0; turn < 3; ++turn) {
    const TemporaryState state;
    const auto better = [](Figures& best, const Figures& one) {
      best = {std::max(best.alone, one.alone), std::max(best.many, one.many),
              std::max(best.bytes, one.bytes)};
    };
    better(kept, measure(state.path().string(), jobs));
    better(forgotten, measure("", jobs));
  }
  std::printf("submits a second, one client: %.0f kept, %.0f not, ratio %.2f\n", kept.alone,
              forgotten.alone, kept.alone / forgotten.alone);
  std::printf("submits a second, 64 clients: %.0f kept, %.0f not, ratio %.2f\n", kept.many,
              forgotten.many, kept.many / forgotten.many);
  std::printf(
      "a finished 4K float picture: %.0f MB/s from the disk, %.0f from memory, ratio %.2f\n",
      kept.bytes / 1e6, forgotten.bytes / 1e6, kept.bytes / forgotten.bytes);
}
