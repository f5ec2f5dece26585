#include "server/service/net/session.h"

#include <spdlog/spdlog.h>

#include "server/service/access/permit.h"
#include "server/service/limits.h"

namespace metamer::service {

namespace {

constexpr auto never = asio::steady_timer::time_point::max();

v1::Envelope error_envelope(v1::Error::Code code, const std::string& message) {
  v1::Envelope envelope;
  envelope.mutable_error()->set_code(code);
  envelope.mutable_error()->set_message(message);
  return envelope;
}

}  // namespace

Session::Session(std::unique_ptr<wire::Stream> stream, Visitor visitor, ServiceContext& context,
                 Handlers handlers)
    : channel_(std::move(stream), wire::Peer::client),
      visitor_(std::move(visitor)),
      context_(context),
      handlers_(std::move(handlers)),
      watches_([this] { sendable_.cancel(); }),
      views_([this] { sendable_.cancel(); }, [this](View& view) { close_view(view); }),
      dispatch_(
          context, [this](const std::string& token) { return admit(token); }, watches_, views_),
      sendable_(channel_.executor(), never),
      room_(channel_.executor(), never),
      timeout_(channel_.executor(), never) {
  channel_.limit_frames(max_frame_before_hello);
  channel_.limit_stall(context.patience.stall);
}

void Session::start(Clock::time_point deadline) {
  timeout_.expires_at(deadline);
  timeout_.async_wait([self = weak_from_this()](boost::system::error_code cancelled) {
    const auto session = self.lock();
    if (session && !cancelled && !session->dispatch_.greeted()) session->close();
  });
  run(read_requests());
  run(write_answers());
}

void Session::end(const Refusal& refusal) {
  log_line(spdlog::level::info, fields(refusal.message), "a session is ended");
  send(error_envelope(refusal.code, refusal.message));
  ending_ = true;
  channel_.shutdown_receive();
  close_soon();
}

/// Lets the peer read the last answer before the connection goes.
void Session::close_soon() {
  timeout_.expires_after(linger_timeout);
  timeout_.async_wait([self = weak_from_this()](boost::system::error_code cancelled) {
    const auto session = self.lock();
    if (session && !cancelled) session->close();
  });
}

tl::expected<Identity, Refusal> Session::admit(const std::string& token) {
  auto identity = context_.logins.login(visitor_, token);
  if (!identity) return identity;
  if (auto place = handlers_.admit(*identity); !place) return tl::unexpected(place.error());
  channel_.lift_frame_limit();
  return identity;
}

void Session::finish(const std::string& message) {
  finishing_ = true;
  watches_.close(message);
  sendable_.cancel();
}

/// No more requests, once there is nothing to send; what has come of them is answered still.
void Session::finish_if_done() {
  if (!finishing_ || watches_.size() > 0 || views_.size() > 0) return;
  if (reads_) return channel_.shutdown_receive();
  ending_ = true;
}

void Session::close() {
  channel_.close();
  sendable_.cancel();
  room_.cancel();
  timeout_.cancel();
}

void Session::run(asio::awaitable<void> loop) {
  ++running_;
  asio::co_spawn(channel_.executor(), std::move(loop),
                 [self = shared_from_this()](const std::exception_ptr& error) {
                   try {
                     if (error) std::rethrow_exception(error);
                   } catch (const std::exception& exception) {
                     log_line(spdlog::level::err, self->fields(exception.what()),
                              "a session ended");
                     self->close();
                   }
                   if (--self->running_ > 0) return;
                   self->watches_.clear();
                   self->views_.clear();
                   self->close();
                   self->handlers_.gone(*self);
                 });
}

asio::awaitable<void> Session::read_requests() {
  while (channel_.is_open() && !ending_) {
    v1::Envelope request;
    const auto got = co_await channel_.read(request);
    if (!got) {
      if (got.error().kind != wire::ChannelError::Kind::frame || ending_) break;
      if (dispatch_.greeted())
        log_line(spdlog::level::info, fields(got.error().message), "a session is closed");
      else
        context_.logins.failed(visitor_, got.error().message);
      // Nothing that follows can be understood: say why and end.
      send(error_envelope(v1::Error::FRAME, got.error().message));
      ending_ = true;
      co_return;
    }
    context_.traffic.received += request.ByteSizeLong();
    // Welcome says what the workers can do; they say so soon after the start.
    if (request.has_hello()) co_await context_.cpu.wait_for_capabilities();
    if (request.has_get_info() && dispatch_.greeted()) {
      context_.gl.start();
      co_await context_.gl.wait_for_capabilities();
    }
    co_await handle(std::move(request));
    while ((answers_.size() >= max_unsent_answers || unsent_bytes_ >= max_unsent_bytes) &&
           channel_.is_open()) {
      co_await room_.async_wait(asio::as_tuple(asio::use_awaitable));
    }
  }
  reads_ = false;
  if (finishing_) {
    sendable_.cancel();
  } else if (!ending_) {
    close();
  }
}

LogFields Session::fields(std::string reason) const {
  return {.peer = visitor_.source(),
          .user = dispatch_.greeted() ? identity().user : std::string(),
          .reason = std::move(reason)};
}

std::optional<Session::Clock::time_point> Session::idle_since() const {
  const bool waits = watches_.size() > 0 || views_.size() > 0;
  if (!channel_.is_open() || (waits && !writing_)) return std::nullopt;
  return last_progress_;
}

/// The next chunk has its time, or what came so far gives its room back.
void Session::limit_upload() {
  timeout_.expires_after(context_.patience.upload);
  timeout_.async_wait([self = weak_from_this()](boost::system::error_code cancelled) {
    const auto session = self.lock();
    if (session && !cancelled) session->dispatch_.drop_upload();
  });
}

asio::awaitable<void> Session::handle(v1::Envelope request) {
  last_progress_ = Clock::now();
  const bool is_chunk = request.has_asset_chunk();
  const bool was_greeted = dispatch_.greeted();
  const std::uint64_t id = request.request_id();
  std::optional<v1::Envelope> answer;
  try {
    answer = co_await dispatch_.answer(std::move(request));
  } catch (const std::exception& exception) {
    log_line(spdlog::level::err, fields(exception.what()), "a request failed");
    answer = error_envelope(v1::Error::INTERNAL, exception.what());
    answer->set_request_id(id);
  }
  if (!was_greeted && dispatch_.greeted())
    log_line(spdlog::level::info, fields(),
             fmt::format("{} says hello: {}", word(identity().role), client()));
  if (is_chunk && dispatch_.uploading()) limit_upload();
  // A watch is answered by its events.
  if (!answer) {
    sendable_.cancel();
    co_return;
  }
  ending_ = ending_ || (answer->has_error() && ends_session(answer->error()));
  send(*std::move(answer));
}

/// Nothing more can come of it: the versions differ, or who asks is not let in.
bool Session::ends_session(const v1::Error& error) const {
  if (error.code() == v1::Error::VERSION || error.code() == v1::Error::UNAUTHENTICATED) return true;
  return !dispatch_.greeted() && error.code() == v1::Error::LIMIT;
}

void Session::send(v1::Envelope answer) {
  unsent_bytes_ += answer.ByteSizeLong();
  answers_.push_back(std::move(answer));
  sendable_.cancel();
}

std::optional<v1::Envelope> Session::next_to_send() {
  if (!answers_.empty()) {
    std::optional<v1::Envelope> answer = std::move(answers_.front());
    answers_.pop_front();
    unsent_bytes_ -= answer->ByteSizeLong();
    room_.cancel();
    return answer;
  }
  if (ending_) return std::nullopt;
  views_next_ = !views_next_;
  auto event = views_next_ ? views_.next() : watches_.next();
  if (!event) event = views_next_ ? watches_.next() : views_.next();
  return event;
}

/// What there is to send, up to a few tiles: each write costs both sides more than its bytes do.
std::string Session::frames_to_send() {
  constexpr std::size_t enough = 64u << 10;
  std::string frames;
  while (frames.size() < enough) {
    const auto message = next_to_send();
    if (!message) break;
    frames += wire::encode_frame(message->SerializeAsString());
  }
  return frames;
}

/// Its client has had its last event, or is gone: then the worker has not heard of it yet.
void Session::close_view(View& view) {
  if (!view.ended()) context_.host_of(view).tell(view.closing());
}

asio::awaitable<void> Session::write_answers() {
  while (channel_.is_open()) {
    std::string frames = frames_to_send();
    if (frames.empty()) finish_if_done();
    if (!frames.empty()) {
      writing_ = true;
      context_.traffic.sent += frames.size();
      const auto sent = co_await channel_.write_frames(std::move(frames));
      writing_ = false;
      last_progress_ = Clock::now();
      if (!sent) {
        if (sent.error().kind == wire::ChannelError::Kind::stalled)
          log_line(spdlog::level::info, fields(sent.error().message), "a session is closed");
        co_return close();
      }
    } else if (ending_) {
      break;
    } else {
      co_await sendable_.async_wait(asio::as_tuple(asio::use_awaitable));
    }
  }
  if (!channel_.is_open()) co_return;

  close_soon();
  co_await channel_.drain();
}

}  // namespace metamer::service
