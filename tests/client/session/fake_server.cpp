#include "fake_server.h"

#include <gtest/gtest.h>
#include <stdlib.h>
#include <unistd.h>

#include <thread>

namespace metamer::test {

namespace asio = boost::asio;

FakeServer::FakeServer(AnswerTo answer) : answer_(std::move(answer)) {
  std::string pattern = "/tmp/metamer-fake-XXXXXX";
  EXPECT_NE(mkdtemp(pattern.data()), nullptr);
  folder_ = pattern;
  wire::Endpoint endpoint;
  endpoint.kind = wire::Endpoint::Kind::unix_socket;
  endpoint.path = folder_ + "/socket";
  auto acceptor = wire::Acceptor::listen(loop_.get_executor(), endpoint);
  EXPECT_TRUE(acceptor);
  if (acceptor) acceptor_.emplace(std::move(*acceptor));
}

FakeServer::~FakeServer() {
  acceptor_.reset();
  rmdir(folder_.c_str());
}

asio::awaitable<void> FakeServer::serve() {
  auto [failed, socket] = co_await acceptor_->accept();
  if (failed) co_return;
  wire::Channel channel(std::move(socket), wire::Peer::client);
  while (true) {
    v1::Envelope request;
    const auto got = co_await channel.read(request);
    if (!got) co_return;
    std::vector<v1::Envelope> answers = answer_(request);
    for (v1::Envelope& one : answers) {
      if (one.body_case() == v1::Envelope::BODY_NOT_SET) co_return;
      if (one.request_id() == 0) one.set_request_id(request.request_id());
      const auto sent = co_await channel.write(one);
      if (!sent) co_return;
    }
  }
}

asio::awaitable<void> FakeServer::serve_all() {
  while (true) co_await serve();
}

void FakeServer::beside(const std::function<void(const std::string&)>& work) {
  asio::co_spawn(loop_, serve_all(), asio::detached);
  std::thread thread([this] { loop_.run(); });
  work("unix:" + folder_ + "/socket");
  loop_.stop();
  thread.join();
}

std::optional<SessionError> FakeServer::run(Work work, ConnectLimits limits,
                                            asio::cancellation_slot cancel) {
  std::optional<SessionError> failure;
  asio::co_spawn(loop_, serve(), asio::detached);
  const auto client = [&]() -> asio::awaitable<void> {
    Answer<std::unique_ptr<Session>> session =
        co_await Session::connect("unix:" + folder_ + "/socket", limits);
    if (session) {
      co_await work(**session);
    } else {
      failure = session.error();
    }
  };
  asio::co_spawn(loop_, client(), asio::bind_cancellation_slot(cancel, asio::detached));
  loop_.run();
  return failure;
}

v1::Envelope welcome(std::uint32_t version) {
  v1::Envelope envelope;
  v1::Welcome& message = *envelope.mutable_welcome();
  message.set_protocol_version(version);
  message.mutable_limits()->set_control_frame(4096);
  message.mutable_limits()->set_chunk(10);
  message.mutable_limits()->set_asset(1000);
  message.mutable_limits()->set_assets_per_job(3);
  return envelope;
}

v1::Envelope error(v1::Error::Code code, const std::string& message) {
  v1::Envelope envelope;
  envelope.mutable_error()->set_code(code);
  envelope.mutable_error()->set_message(message);
  return envelope;
}

v1::Envelope event(std::uint64_t sequence) {
  v1::Envelope envelope;
  envelope.mutable_job_event()->set_sequence(sequence);
  envelope.mutable_job_event()->mutable_progress();
  return envelope;
}

v1::Envelope last_event(std::uint64_t sequence) {
  v1::Envelope envelope;
  envelope.mutable_job_event()->set_sequence(sequence);
  envelope.mutable_job_event()->mutable_cancelled();
  return envelope;
}

}  // namespace metamer::test
