#include "tests/client/gui/link/relay.h"

#include <gtest/gtest.h>

#include <boost/asio.hpp>
#include <deque>
#include <future>
#include <set>
#include <thread>

#include "client/session/private_server.h"
#include "common/wire/channel.h"

namespace metamer::gui {
namespace {

namespace asio = boost::asio;
using Clock = std::chrono::steady_clock;
constexpr std::size_t most_bodies = 256;  // of Envelope

/// A window's connection and that to the server.
struct Pair {
  Pair(wire::Socket near, wire::Socket far)
      : client(std::move(near), wire::Peer::client),
        server(std::move(far), wire::Peer::server),
        more(client.executor(), Clock::time_point::max()) {}
  void close() {
    client.close();
    server.close();
    closed = true;
    more.cancel();
  }
  void answer(v1::Envelope envelope, Clock::time_point due) {
    answers.emplace_back(due, std::move(envelope));
    more.cancel();
  }

  wire::Channel client, server;
  std::deque<std::pair<Clock::time_point, v1::Envelope>> answers;
  asio::steady_timer more;  ///< Cancelled when there are answers.
  bool closed = false;
};

using PairPtr = std::shared_ptr<Pair>;

asio::awaitable<void> wait(asio::steady_timer& timer) {
  boost::system::error_code cancelled;
  co_await timer.async_wait(asio::redirect_error(asio::use_awaitable, cancelled));
}

}  // namespace

struct Relay::State {
  explicit State(Relay& of) : relay(of) {}

  asio::awaitable<void> accept_all() {
    while (true) {
      auto [failed, socket] = co_await acceptor->accept();
      if (failed) co_return;
      if (relay.refuses) continue;
      const auto endpoint = wire::parse_endpoint("unix:" + server->socket().string());
      auto far = co_await wire::connect(*endpoint);
      if (!far) continue;
      const auto pair = std::make_shared<Pair>(std::move(socket), std::move(*far));
      pairs.insert(pair);
      asio::co_spawn(loop, pass_requests(pair), asio::detached);
      asio::co_spawn(loop, take_answers(pair), asio::detached);
      asio::co_spawn(loop, pass_answers(pair), asio::detached);
    }
  }

  asio::awaitable<void> pass_requests(PairPtr pair) {
    while (!pair->closed) {
      v1::Envelope request;
      if (!co_await pair->client.read(request)) break;
      ++relay.counts_[static_cast<std::size_t>(request.body_case()) % most_bodies];
      if (auto own = relay.on_request ? relay.on_request(request) : std::nullopt) {
        own->set_request_id(request.request_id());
        pair->answer(*own, Clock::now() + relay.delay.load());
      } else if (!co_await pair->server.write(request)) {
        break;
      }
    }
    end(pair);
  }

  asio::awaitable<void> take_answers(PairPtr pair) {
    while (!pair->closed) {
      v1::Envelope answer;
      if (!co_await pair->server.read(answer)) break;
      if (relay.on_answer && !relay.on_answer(answer)) break;
      pair->answer(std::move(answer), Clock::now() + relay.delay.load());
    }
    end(pair);
  }

  asio::awaitable<void> pass_answers(PairPtr pair) {
    while (!pair->closed) {
      if (pair->answers.empty()) {
        pair->more.expires_at(Clock::time_point::max());
        co_await wait(pair->more);
        continue;
      }
      auto [due, answer] = std::move(pair->answers.front());
      pair->answers.pop_front();
      asio::steady_timer timer(loop, due);
      if (due > Clock::now()) co_await wait(timer);
      if (pair->closed || !co_await pair->client.write(answer)) break;
    }
    end(pair);
  }

  void end(const PairPtr& pair) {
    if (pairs.erase(pair) > 0) pair->close();
  }

  Relay& relay;
  asio::io_context loop{1};
  std::optional<client::PrivateServer> server;
  std::optional<wire::Acceptor> acceptor;
  std::string folder;
  std::set<PairPtr> pairs;
  std::thread thread;
};

Relay::Relay() : counts_(most_bodies), state_(std::make_unique<State>(*this)) {
  std::string pattern = "/tmp/metamer-relay-XXXXXX";
  EXPECT_NE(mkdtemp(pattern.data()), nullptr);
  state_->folder = pattern;
  const auto start = [this]() -> asio::awaitable<void> {
    auto server = co_await client::PrivateServer::start();
    if (server) state_->server.emplace(std::move(*server));
  };
  asio::co_spawn(state_->loop, start(), asio::detached);
  state_->loop.run();
  state_->loop.restart();
  EXPECT_TRUE(state_->server) << "no metamerd";
  auto acceptor =
      wire::Acceptor::listen(state_->loop.get_executor(), *wire::parse_endpoint(address()));
  EXPECT_TRUE(acceptor);
  if (!acceptor || !state_->server) return;
  state_->acceptor.emplace(std::move(*acceptor));
  asio::co_spawn(state_->loop, state_->accept_all(), asio::detached);
  state_->thread = std::thread([this] { state_->loop.run(); });
}

Relay::~Relay() {
  state_->loop.stop();
  if (state_->thread.joinable()) state_->thread.join();
  state_->pairs.clear();
  state_->acceptor.reset();
  rmdir(state_->folder.c_str());
}

std::string Relay::address() const { return "unix:" + state_->folder + "/socket"; }

void Relay::cut() {
  std::promise<void> done;
  asio::post(state_->loop, [&] {
    for (const auto& pair : std::exchange(state_->pairs, {})) pair->close();
    done.set_value();
  });
  done.get_future().wait();
}

}  // namespace metamer::gui
