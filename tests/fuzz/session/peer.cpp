#include "peer.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>

#include "../check.h"

namespace metamer::fuzz {

namespace {

using Body = v1::Envelope;

/// So many bytes may wait to be sent; then nothing more is asked.
constexpr std::size_t most_unsent = 1 << 20;

bool is_last(const v1::JobEvent& event) {
  return event.has_finished() || event.has_failed() || event.has_cancelled();
}

/// Which job a request names; 0: none.
std::uint64_t job_of(const v1::Envelope& request) {
  switch (request.body_case()) {
    case Body::kWatch:
      return request.watch().job_id();
    case Body::kCancel:
      return request.cancel().job_id();
    case Body::kPause:
      return request.pause().job_id();
    case Body::kResume:
      return request.resume().job_id();
    case Body::kPrioritize:
      return request.prioritize().job_id();
    default:
      return 0;
  }
}

}  // namespace

Peer::Peer(Facts& facts, const std::string& path)
    : facts_(facts), fd_(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, path.c_str(), sizeof address.sun_path - 1);
  if (::connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) close();
}

Peer::Peer(Facts& facts, std::uint16_t port, std::uint8_t host)
    : facts_(facts), fd_(::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK - 1 + host);
  bool connected = ::bind(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(port);
  connected =
      connected && ::connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  ::fcntl(fd_, F_SETFL, ::fcntl(fd_, F_GETFL) | O_NONBLOCK);
  if (!connected) close();
}

Peer::~Peer() { reset(); }

void Peer::close() {
  if (fd_ >= 0) ::close(std::exchange(fd_, -1));
  closed_ = true;
}

void Peer::reset() {
  const linger at_once{1, 0};
  if (fd_ >= 0) ::setsockopt(fd_, SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
  close();
}

void Peer::finish_sending() {
  flush();
  if (fd_ >= 0) ::shutdown(fd_, SHUT_WR);
  spoiled_ = true;
}

void Peer::note(const v1::Envelope& request) {
  ++facts_.requests;
  Asked& asked = ledger_[request.request_id()];
  ++asked.times;
  asked.job = job_of(request);
  asked.over = false;
  switch (request.body_case()) {
    // Answered by events, or by an Error.
    case Body::kWatch:
    case Body::kOpenView:
      asked.streams = true;
      return;
    // By an Error alone; a chunk by AssetStored where it is the last.
    case Body::kAssetChunk:
    case Body::kUpdateView:
    case Body::kNextFrame:
    case Body::kCloseView:
    case Body::kProbe:
      ++asked.most;
      return;
    default:
      ++asked.least;
      ++asked.most;
  }
}

void Peer::ask(v1::Envelope request, bool same_id) {
  if (!can_ask() || unsent_.size() > most_unsent) return;
  finish_half();
  request.set_request_id(same_id && last_id_ > 0 ? last_id_ : ++last_id_);
  note(request);
  send(wire::encode_frame(request.SerializeAsString()));
}

void Peer::ask_half(v1::Envelope request, std::size_t bytes) {
  if (!can_ask() || unsent_.size() > most_unsent) return;
  finish_half();
  request.set_request_id(++last_id_);
  half_ = wire::encode_frame(request.SerializeAsString());
  bytes = std::min(bytes, half_.size() - 1);
  send(half_.substr(0, bytes));
  half_.erase(0, bytes);
  halved_ = std::move(request);
}

void Peer::finish_half() {
  if (!halved_) return;
  note(*std::exchange(halved_, std::nullopt));
  send(std::exchange(half_, {}));
}

void Peer::send_frame(const std::string& payload) {
  if (!can_ask() || payload.empty()) return;
  finish_half();
  v1::Envelope request;
  if (request.ParseFromString(payload))
    note(request);
  else
    spoiled_ = true;
  send(wire::encode_frame(payload));
}

void Peer::send_garbage(const std::string& bytes) {
  if (!can_ask() || bytes.empty()) return;
  halved_.reset();
  spoiled_ = true;
  send(bytes);
}

void Peer::ask_last() {
  if (!can_ask()) return;
  unsent_.reserve(0);
  v1::Envelope ping;
  ping.mutable_ping();
  finish_half();
  ping.set_request_id(++last_id_);
  note(ping);
  last_ = last_id_;
  send(wire::encode_frame(ping.SerializeAsString()));
}

void Peer::send(const std::string& bytes) {
  unsent_ += bytes;
  flush();
}

void Peer::flush() {
  while (!unsent_.empty() && fd_ >= 0) {
    const ssize_t sent = ::send(fd_, unsent_.data(), unsent_.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
    if (sent < 0 && errno != EAGAIN && errno != EINTR) unsent_.clear();
    if (sent <= 0) return;
    unsent_.erase(0, static_cast<std::size_t>(sent));
  }
}

void Peer::read(std::size_t most) {
  flush();
  std::array<char, 16384> piece;
  while (most > 0 && !closed_) {
    const ssize_t got = ::recv(fd_, piece.data(), std::min(most, piece.size()), MSG_DONTWAIT);
    if (got < 0 && (errno == EAGAIN || errno == EINTR)) return;
    if (got <= 0) return close();
    most -= static_cast<std::size_t>(got);
    decoder_.feed({piece.data(), static_cast<std::size_t>(got)});
    while (true) {
      auto payload = decoder_.next();
      check(payload.has_value(), "the server sends frames");
      if (!*payload) break;
      v1::Envelope message;
      check(message.ParseFromString(**payload), "a frame of the server holds an Envelope");
      take(message);
    }
  }
}

bool Peer::is_mine(std::uint64_t job) const {
  const auto owner = facts_.owners.find(job);
  return is_admin_ || owner == facts_.owners.end() || owner->second == user_;
}

/// What it says of a job that is not this client's: nothing.
void Peer::check_stranger(const Asked& asked, const v1::Envelope& message) const {
  if (asked.times > 1 || asked.job == 0 || is_mine(asked.job)) return;
  check(message.has_error(), "a stranger's job is not shown");
  switch (message.error().code()) {
    case v1::Error::NOT_FOUND:
    case v1::Error::FORBIDDEN:
    case v1::Error::ORDER:
      return;
    default:
      check(false, "a stranger's job is NOT_FOUND");
  }
}

void Peer::take_event(Asked& asked, const v1::JobEvent& event) const {
  check(is_mine(event.job_id()), "events of a stranger's job are not sent");
  if (asked.times > 1) return;
  check(event.job_id() == asked.job, "a watch has its own job's events");
  check(event.sequence() > asked.sequence || is_last(event), "events come in order");
  asked.sequence = event.sequence();
  asked.over = is_last(event);
}

void Peer::take(const v1::Envelope& message) {
  ++facts_.answers;
  latest_ = message;
  const auto found = ledger_.find(message.request_id());
  if (found == ledger_.end()) {
    const auto code = message.error().code();
    check(code == v1::Error::FRAME || code == v1::Error::UNAUTHENTICATED,
          "an answer has the id of a request");
    return;
  }
  Asked& asked = found->second;
  ++asked.got;
  check(asked.streams || asked.got <= asked.most ||
            (message.request_id() == 0 && message.has_error()),
        "a request has one answer");
  check(!asked.over || asked.times > 1, "nothing follows the last event");
  check_stranger(asked, message);
  switch (message.body_case()) {
    case Body::kWelcome:
      user_ = message.welcome().user();
      is_admin_ = message.welcome().role() == v1::ADMIN;
      break;
    case Body::kSubmitted:
      facts_.owners[message.submitted().job_id()] = user_;
      break;
    case Body::kJobEvent:
      take_event(asked, message.job_event());
      break;
    case Body::kJobList:
      for (const v1::JobSummary& job : message.job_list().job())
        check(is_admin_ || job.user() == user_, "a stranger's job is not listed");
      break;
    case Body::kViewEvent:
      if (facts_.views.size() < 64) facts_.views.push_back(message.view_event().view_id());
      asked.over = message.view_event().has_closed();
      break;
    case Body::kError:
      asked.over = asked.streams;
      break;
    default:
      break;
  }
}

void Peer::check_answers() const {
  for (const auto& [id, asked] : ledger_)
    check(asked.got >= asked.least, "each request has an answer");
}

}  // namespace metamer::fuzz
