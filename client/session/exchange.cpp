#include "client/session/exchange.h"

#include <utility>

namespace metamer::client {
namespace {

using Kind = SessionError::Kind;

constexpr std::size_t inbox_size = 16;
constexpr auto as_tuple = asio::as_tuple(asio::use_awaitable);

}  // namespace

tl::unexpected<SessionError> refused(const v1::Error& error) {
  SessionError result;
  result.kind = error.code() == v1::Error::VERSION   ? Kind::version
                : error.code() == v1::Error::CLOSING ? Kind::disconnected
                                                     : Kind::refused;
  result.message = error.message();
  result.code = error.code();
  result.problems.assign(error.problem().begin(), error.problem().end());
  return tl::unexpected<SessionError>(std::move(result));
}

tl::unexpected<SessionError> unexpected_answer() {
  return session_error(Kind::disconnected, "the server sent an answer that fits no question");
}

Session::Exchange::Exchange(std::shared_ptr<State> state)
    : state_(std::move(state)),
      id_(++state_->last_id),
      inbox_(std::make_shared<Inbox>(state_->channel.executor(), inbox_size)) {
  state_->inboxes.emplace(id_, inbox_);
}

Session::Exchange::~Exchange() {
  inbox_->close();
  std::erase_if(state_->inboxes, [&](const auto& known) { return known.second == inbox_; });
}

std::uint64_t Session::Exchange::add_request() {
  state_->inboxes.emplace(++state_->last_id, inbox_);
  return state_->last_id;
}

asio::awaitable<Answer<v1::Envelope>> Session::Exchange::receive_any() {
  if (state_->lost && !inbox_->ready()) co_return state_->why_lost();
  auto [error, envelope] = co_await inbox_->async_receive(as_tuple);
  if (error) co_return state_->why_lost();
  co_return Answer<v1::Envelope>(std::move(envelope));
}

asio::awaitable<Answer<v1::Envelope>> Session::Exchange::receive() {
  Answer<v1::Envelope> answer = co_await receive_any();
  if (answer && answer->has_error()) co_return refused(answer->error());
  co_return answer;
}

asio::awaitable<void> Session::State::read_all(std::shared_ptr<State> state) {
  while (!state->lost) {
    v1::Envelope envelope;
    const auto got = co_await state->channel.read(envelope);
    if (!got) {
      state->lose(got.error().tls ? "it speaks TLS there: try tls:" + state->server
                                  : got.error().message);
      co_return;
    }
    const auto found = state->inboxes.find(envelope.request_id());
    if (found == state->inboxes.end()) {
      // What belongs to no request is about the connection, or comes too late.
      if (envelope.has_error() && envelope.request_id() == 0)
        state->lose(envelope.error().message());
      continue;
    }
    const std::shared_ptr<Inbox> inbox = found->second;
    co_await inbox->async_send(error_code(), std::move(envelope), as_tuple);
  }
}

asio::awaitable<void> Session::State::write(const v1::Envelope& envelope) {
  co_await write_turn.async_send(error_code(), as_tuple);
  if (!lost) {
    const auto written = co_await channel.write(envelope);
    // The server may have said why before it closed: let the reader come to it.
    if (!written) channel.shutdown_receive();
  }
  co_await write_turn.async_receive(as_tuple);
}

}  // namespace metamer::client
