#include "client.h"

#include <gtest/gtest.h>
#include <linux/filter.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstring>

#include "common/digest.h"

namespace metamer::service::test {

namespace {
constexpr int patience = 20'000;  // ms
}

Client::Client(const std::string& path) : fd_(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
  if (::connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    ::close(fd_);
    throw std::runtime_error("can't connect to " + path);
  }
}

Client::Client(std::uint16_t port) : fd_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  if (::connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    ::close(fd_);
    throw std::runtime_error("can't connect to port " + std::to_string(port));
  }
}

Client::~Client() { ::close(fd_); }

void Client::send_bytes(const std::string& bytes) {
  std::string_view rest = bytes;
  while (!rest.empty()) {
    const ssize_t sent = ::send(fd_, rest.data(), rest.size(), MSG_NOSIGNAL);
    if (sent <= 0) return;
    rest.remove_prefix(static_cast<std::size_t>(sent));
  }
}

void Client::send(const v1::Envelope& message) {
  send_bytes(wire::encode_frame(message.SerializeAsString()));
}

std::optional<v1::Envelope> Client::receive() { return receive_within(patience); }

std::optional<v1::Envelope> Client::receive_if_there() { return receive_within(0); }

std::optional<v1::Envelope> Client::receive_within(int milliseconds) {
  while (true) {
    auto payload = decoder_.next();
    if (!payload) throw std::runtime_error(wire::describe(payload.error()));
    if (*payload) {
      v1::Envelope message;
      if (!message.ParseFromString(**payload)) throw std::runtime_error("no Envelope");
      return message;
    }
    pollfd waiting{fd_, POLLIN, 0};
    if (::poll(&waiting, 1, milliseconds) != 1) {
      if (milliseconds == 0) return std::nullopt;
      throw std::runtime_error("the server is silent");
    }
    std::array<char, 65536> piece;
    const ssize_t got = ::recv(fd_, piece.data(), piece.size(), 0);
    if (got <= 0) return std::nullopt;
    decoder_.feed({piece.data(), static_cast<std::size_t>(got)});
  }
}

v1::Envelope Client::ask(v1::Envelope message) {
  message.set_request_id(++last_request_);
  send(message);
  while (true) {
    auto answer = receive();
    if (!answer) throw std::runtime_error("the server closed instead of an answer");
    if (answer->request_id() == last_request_) return *answer;
    if (answer->has_job_event()) events_.push_back(answer->job_event());
  }
}

v1::JobEvent Client::receive_event() {
  if (!events_.empty()) {
    v1::JobEvent event = events_.front();
    events_.erase(events_.begin());
    return event;
  }
  auto message = receive();
  if (!message) throw std::runtime_error("the server closed instead of an event");
  if (!message->has_job_event()) throw std::runtime_error(message->ShortDebugString());
  return message->job_event();
}

v1::JobEvent Client::receive_event_until(const std::function<bool(const v1::JobEvent&)>& wanted) {
  while (true) {
    v1::JobEvent event = receive_event();
    if (wanted(event)) return event;
    if (event.has_finished() || event.has_failed() || event.has_cancelled()) {
      throw std::runtime_error("the job ended: " + event.ShortDebugString());
    }
  }
}

bool Client::closed_by_server() {
  decoder_ = wire::FrameDecoder();
  return !receive();
}

void Client::finish_sending() { ::shutdown(fd_, SHUT_WR); }

void Client::vanish() {
  sock_filter nothing = BPF_STMT(BPF_RET | BPF_K, 0);
  const sock_fprog filter{1, &nothing};
  if (::setsockopt(fd_, SOL_SOCKET, SO_ATTACH_FILTER, &filter, sizeof filter) != 0)
    throw std::runtime_error("a socket can't be made deaf");
}

v1::Envelope Client::log_in(const std::string& token) {
  v1::Envelope message;
  message.mutable_hello()->set_protocol_version(1);
  message.mutable_hello()->set_client("test");
  message.mutable_hello()->set_token(token);
  return ask(message);
}

v1::Welcome Client::hello(const std::string& token) {
  const v1::Envelope answer = log_in(token);
  EXPECT_TRUE(answer.has_welcome()) << answer.ShortDebugString();
  return answer.welcome();
}

v1::Info Client::info() {
  v1::Envelope message;
  message.mutable_get_info();
  return ask(message).info();
}

std::vector<std::string> Client::upload(const std::vector<std::string>& assets) {
  v1::Envelope offer;
  offer.mutable_offer_assets();
  std::vector<std::string> digests;
  for (const std::string& asset : assets) {
    digests.emplace_back(to_bytes(sha256(asset)));
    offer.mutable_offer_assets()->add_sha256(digests.back());
  }
  const v1::Envelope missing = ask(offer);
  for (const std::string& digest : missing.missing_assets().sha256()) {
    for (std::size_t i = 0; i < assets.size(); ++i) {
      if (digests[i] != digest) continue;
      v1::Envelope message;
      message.mutable_asset_chunk()->set_sha256(digest);
      message.mutable_asset_chunk()->set_size(assets[i].size());
      message.mutable_asset_chunk()->set_data(assets[i]);
      const v1::Envelope stored = ask(message);
      EXPECT_TRUE(stored.has_asset_stored()) << stored.ShortDebugString();
    }
  }
  return digests;
}

std::uint64_t Client::submit(const std::string& scene, bool check_only, bool keep_factors) {
  v1::Envelope message;
  message.mutable_submit()->set_name("scene");
  message.mutable_submit()->set_scene_sha256(upload({scene})[0]);
  message.mutable_submit()->set_check_only(check_only);
  message.mutable_submit()->set_keep_factors(keep_factors);
  const v1::Envelope answer = ask(message);
  EXPECT_TRUE(answer.has_submitted()) << answer.ShortDebugString();
  return answer.submitted().job_id();
}

std::uint64_t Client::watch(std::uint64_t job, std::uint64_t from, bool tiles, bool previews,
                            bool factors) {
  v1::Envelope message;
  message.set_request_id(++last_request_);
  message.mutable_watch()->set_job_id(job);
  message.mutable_watch()->set_from_sequence(from);
  message.mutable_watch()->set_tiles(tiles);
  message.mutable_watch()->set_previews(previews);
  message.mutable_watch()->set_factors(factors);
  send(message);
  return last_request_;
}

v1::JobSummary Client::summary(std::uint64_t job) {
  v1::Envelope message;
  message.mutable_list_jobs();
  const v1::Envelope answer = ask(message);
  for (const v1::JobSummary& summary : answer.job_list().job()) {
    if (summary.job_id() == job) return summary;
  }
  return {};
}

void Client::ping() {
  v1::Envelope message;
  message.mutable_ping();
  EXPECT_TRUE(ask(message).has_pong());
}

}  // namespace metamer::service::test
