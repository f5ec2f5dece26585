#include "client/session/session.h"

#include <algorithm>
#include <chrono>
#include <map>
#include <utility>

#include "client/session/exchange.h"
#include "client/session/server_owner.h"
#include "common/wire/endpoint.h"
#include "common/wire/peer.h"
#include "common/wire/protocol.h"

namespace metamer::client {
namespace {

using Kind = SessionError::Kind;

}  // namespace

Session::Session(std::shared_ptr<State> state) : state_(std::move(state)) {}

Session::~Session() { state_->lose("it was closed"); }

const v1::Welcome& Session::welcome() const { return state_->welcome; }

asio::awaitable<Answer<std::unique_ptr<Session>>> Session::connect(std::string server,
                                                                   ConnectLimits limits) {
  const auto endpoint = wire::parse_endpoint(server);
  if (!endpoint) co_return session_error(Kind::input, endpoint.error().message);
  auto socket = co_await wire::connect(*endpoint, limits.connection);
  if (!socket) co_return session_error(Kind::no_server, socket.error().message);
  if (const auto user = wire::peer_of(*socket).user) {
    const auto met = check_server_owner(*user, endpoint->path);
    if (!met) co_return session_error(Kind::no_server, met.error().message);
  }

  const auto executor = co_await asio::this_coro::executor;
  auto state = std::make_shared<State>(std::move(*socket), wire::to_string(*endpoint));
  asio::co_spawn(executor, State::read_all(state), asio::detached);
  std::unique_ptr<Session> session(new Session(state));

  // Give up the handshake after its time, or when this coroutine is cancelled.
  asio::steady_timer timer(executor, limits.welcome);
  timer.async_wait([state](error_code cancelled) {
    if (!cancelled) state->lose("it did not answer the handshake");
  });
  Answer<void> greeted;
  try {
    greeted = co_await session->shake_hands();
  } catch (const boost::system::system_error& error) {
    if (error.code() != asio::error::operation_aborted) throw;
  }
  const auto cancellation = co_await asio::this_coro::cancellation_state;
  if (cancellation.cancelled() != asio::cancellation_type::none)
    co_return session_error(Kind::no_server,
                            "can't connect to " + state->server + ": Operation canceled");
  if (!greeted) co_return tl::unexpected<SessionError>(std::move(greeted.error()));
  co_return Answer<std::unique_ptr<Session>>(std::move(session));
}

asio::awaitable<Answer<void>> Session::shake_hands() {
  v1::Envelope request;
  request.mutable_hello()->set_protocol_version(wire::protocol_version);
  request.mutable_hello()->set_client(std::string("metamer ") + METAMER_VERSION);
  Answer<v1::Envelope> answer = co_await ask(std::move(request));
  if (!answer) co_return tl::unexpected<SessionError>(std::move(answer.error()));
  if (!answer->has_welcome()) co_return unexpected_answer();
  v1::Welcome& welcome = state_->welcome;
  welcome = std::move(*answer->mutable_welcome());
  if (welcome.protocol_version() != wire::protocol_version)
    co_return session_error(Kind::version, state_->server + " speaks version " +
                                               std::to_string(welcome.protocol_version()) +
                                               " of the protocol, this program version " +
                                               std::to_string(wire::protocol_version));
  co_return Answer<void>();
}

asio::awaitable<Answer<v1::Envelope>> Session::ask(v1::Envelope request) {
  // Keep to the server's limit; before Welcome there is none to keep to.
  const std::uint64_t limit = state_->welcome.limits().control_frame();
  if (limit > 0 && request.ByteSizeLong() + 16 > limit)
    co_return session_error(Kind::input, "a request of " + std::to_string(request.ByteSizeLong()) +
                                             " bytes is over the server's limit of " +
                                             std::to_string(limit));
  Exchange exchange(state_);
  request.set_request_id(exchange.id());
  co_await state_->write(request);
  co_return co_await exchange.receive();
}

asio::awaitable<Answer<double>> Session::ping() {
  v1::Envelope request;
  request.mutable_ping();
  const auto begin = std::chrono::steady_clock::now();
  Answer<v1::Envelope> answer = co_await ask(std::move(request));
  if (!answer) co_return tl::unexpected<SessionError>(std::move(answer.error()));
  if (!answer->has_pong()) co_return unexpected_answer();
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
  co_return taken.count();
}

asio::awaitable<Answer<v1::Info>> Session::info() {
  v1::Envelope request;
  request.mutable_get_info();
  Answer<v1::Envelope> answer = co_await ask(std::move(request));
  if (!answer) co_return tl::unexpected<SessionError>(std::move(answer.error()));
  if (!answer->has_info()) co_return unexpected_answer();
  co_return std::move(*answer->mutable_info());
}

asio::awaitable<Answer<v1::JobList>> Session::list() {
  v1::Envelope request;
  request.mutable_list_jobs();
  Answer<v1::Envelope> answer = co_await ask(std::move(request));
  if (!answer) co_return tl::unexpected<SessionError>(std::move(answer.error()));
  if (!answer->has_job_list()) co_return unexpected_answer();
  co_return std::move(*answer->mutable_job_list());
}

asio::awaitable<Answer<v1::JobSummary>> Session::control(v1::Envelope request) {
  Answer<v1::Envelope> answer = co_await ask(std::move(request));
  if (!answer) co_return tl::unexpected<SessionError>(std::move(answer.error()));
  if (!answer->has_job_summary()) co_return unexpected_answer();
  co_return std::move(*answer->mutable_job_summary());
}

asio::awaitable<Answer<v1::JobSummary>> Session::cancel(std::uint64_t job_id) {
  v1::Envelope request;
  request.mutable_cancel()->set_job_id(job_id);
  return control(std::move(request));
}

asio::awaitable<Answer<v1::JobSummary>> Session::pause(std::uint64_t job_id) {
  v1::Envelope request;
  request.mutable_pause()->set_job_id(job_id);
  return control(std::move(request));
}

asio::awaitable<Answer<v1::JobSummary>> Session::resume(std::uint64_t job_id) {
  v1::Envelope request;
  request.mutable_resume()->set_job_id(job_id);
  return control(std::move(request));
}

asio::awaitable<Answer<void>> Session::send_missing(const std::vector<Upload>& uploads) {
  const v1::Limits& limits = state_->welcome.limits();
  if (uploads.size() > limits.assets_per_job())
    co_return session_error(
        Kind::input, "the scene and its files are " + std::to_string(uploads.size()) +
                         " assets; the server takes " + std::to_string(limits.assets_per_job()));

  // Ask what the server lacks, in as many requests as the limit of a frame makes necessary.
  constexpr std::size_t digests_at_once = 4096;  // × 34 bytes: 136 KiB
  std::map<Digest, const Upload*> missing;
  for (std::size_t begin = 0; begin < uploads.size(); begin += digests_at_once) {
    const std::size_t end = std::min(begin + digests_at_once, uploads.size());
    v1::Envelope offer;
    std::map<Digest, const Upload*> offered;
    for (std::size_t i = begin; i < end; ++i) {
      const Upload& upload = uploads[i];
      offer.mutable_offer_assets()->add_sha256(std::string(to_bytes(upload.sha256)));
      offered.emplace(upload.sha256, &upload);
    }
    Answer<v1::Envelope> answer = co_await ask(std::move(offer));
    if (!answer) co_return tl::unexpected<SessionError>(std::move(answer.error()));
    if (!answer->has_missing_assets()) co_return unexpected_answer();
    for (const std::string& bytes : answer->missing_assets().sha256()) {
      const auto digest = digest_from_bytes(bytes);
      const auto found = digest ? offered.find(*digest) : offered.end();
      if (found == offered.end()) co_return unexpected_answer();
      missing.insert(*found);
    }
  }

  // Send only that.
  for (const auto& [digest, upload] : missing) {
    Answer<void> sent = co_await send(*upload);
    if (!sent) co_return tl::unexpected<SessionError>(std::move(sent.error()));
  }
  co_return Answer<void>();
}

asio::awaitable<Answer<std::uint64_t>> Session::submit(const Submission& submission) {
  Answer<void> sent = co_await send_missing(submission.uploads);
  if (!sent) co_return tl::unexpected<SessionError>(std::move(sent.error()));
  v1::Envelope request;
  *request.mutable_submit() = submission.request;
  Answer<v1::Envelope> answer = co_await ask(std::move(request));
  if (!answer) co_return tl::unexpected<SessionError>(std::move(answer.error()));
  if (!answer->has_submitted()) co_return unexpected_answer();
  co_return answer->submitted().job_id();
}

asio::awaitable<Answer<void>> Session::send(const Upload& upload) {
  const v1::Limits& limits = state_->welcome.limits();
  if (upload.size > limits.asset())
    co_return session_error(Kind::input, upload.name + " has " + std::to_string(upload.size) +
                                             " bytes; the server takes " +
                                             std::to_string(limits.asset()));
  const std::uint64_t chunk = std::clamp<std::uint64_t>(limits.chunk(), 1, wire::max_chunk);
  Answer<Chunks> chunks = Chunks::open(upload, chunk);
  if (!chunks) co_return tl::unexpected<SessionError>(std::move(chunks.error()));

  // Stop early when the server has said something already: that can only be a refusal.
  Exchange exchange(state_);
  while (!chunks->done() && !exchange.has_answer() && !state_->lost) {
    Answer<v1::AssetChunk> piece = chunks->next();
    if (!piece) co_return tl::unexpected<SessionError>(std::move(piece.error()));
    v1::Envelope envelope;
    envelope.set_request_id(exchange.id());
    *envelope.mutable_asset_chunk() = std::move(*piece);
    co_await state_->write(envelope);
  }
  Answer<v1::Envelope> answer = co_await exchange.receive();
  if (!answer) co_return tl::unexpected<SessionError>(std::move(answer.error()));
  if (!answer->has_asset_stored()) co_return unexpected_answer();
  co_return Answer<void>();
}

asio::awaitable<Answer<void>> Session::watch(v1::Watch request, OnEvent on_event) {
  Exchange exchange(state_);
  v1::Envelope envelope;
  envelope.set_request_id(exchange.id());
  *envelope.mutable_watch() = std::move(request);
  co_await state_->write(envelope);

  while (true) {
    Answer<v1::Envelope> answer = co_await exchange.receive();
    if (!answer) co_return tl::unexpected<SessionError>(std::move(answer.error()));
    if (!answer->has_job_event()) co_return unexpected_answer();
    const v1::JobEvent& event = answer->job_event();
    Answer<void> taken = on_event(event);
    if (!taken) co_return tl::unexpected<SessionError>(std::move(taken.error()));
    if (event.has_finished() || event.has_failed() || event.has_cancelled())
      co_return Answer<void>();
  }
}

}  // namespace metamer::client
