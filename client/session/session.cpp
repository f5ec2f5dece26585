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
#include "common/wire/tls.h"

namespace metamer::client {
namespace {

using Kind = SessionError::Kind;

/// Why TLS came to nothing, and what the user may do.
std::string tls_advice(const wire::TlsError& error, const wire::Endpoint& endpoint) {
  const std::string server = wire::to_string(endpoint);
  switch (error.kind) {
    case wire::TlsError::Kind::no_tls:
      return "can't connect to " + server + ": " + error.message + "; try it without tls:";
    case wire::TlsError::Kind::untrusted:
      return "can't trust " + server + ": " + error.message +
             ". Its certificate's fingerprint is " + error.fingerprint +
             ": where its administrator has told you the same, metamer login " + server +
             " --fingerprint " + error.fingerprint;
    case wire::TlsError::Kind::failed:
      break;
  }
  return "can't connect to " + server + ": " + error.message;
}

/// TLS on a connection, within a time.
asio::awaitable<Answer<std::unique_ptr<wire::Stream>>> encrypted(
    wire::Socket socket, const wire::Endpoint& endpoint, const Credentials& credentials,
    std::chrono::steady_clock::duration limit) {
  const auto context = wire::TlsContext::client({credentials.authorities, credentials.fingerprint},
                                                {credentials.certificate, credentials.key});
  if (!context) co_return session_error(Kind::input, context.error().message);
  const auto abort = std::make_shared<wire::Abort>();
  asio::steady_timer timer(co_await asio::this_coro::executor, limit);
  timer.async_wait([abort](error_code cancelled) {
    if (!cancelled && *abort) (*abort)();
  });
  auto stream = co_await wire::connect_tls(std::move(socket), *context, endpoint.host, abort.get());
  timer.cancel();
  if (!stream) co_return session_error(Kind::no_server, tls_advice(stream.error(), endpoint));
  co_return Answer<std::unique_ptr<wire::Stream>>(*std::move(stream));
}

/// The stream to a server that may be told a token.
asio::awaitable<Answer<std::unique_ptr<wire::Stream>>> reach(const wire::Endpoint& endpoint,
                                                             const Credentials& credentials,
                                                             const ConnectLimits& limits) {
  auto socket = co_await wire::connect(endpoint, limits.connection);
  if (!socket) co_return session_error(Kind::no_server, socket.error().message);
  const wire::PeerIdentity peer = wire::peer_of(*socket);
  if (peer.user) {
    const auto met = check_server_owner(*peer.user, endpoint.path);
    if (!met) co_return session_error(Kind::no_server, met.error().message);
  }
  if (endpoint.tls)
    co_return co_await encrypted(std::move(*socket), endpoint, credentials, limits.welcome);
  if (!credentials.token.empty() && !peer.local)
    co_return session_error(Kind::input, "your token for " + wire::to_string(endpoint) +
                                             " would be sent where others can read it: use tls:" +
                                             wire::to_string(endpoint));
  co_return Answer<std::unique_ptr<wire::Stream>>(wire::plain_stream(std::move(*socket)));
}

}  // namespace

Session::Session(std::shared_ptr<State> state) : state_(std::move(state)) {}

Session::~Session() { state_->lose("it was closed"); }

const v1::Welcome& Session::welcome() const { return state_->welcome; }
const std::optional<std::string>& Session::lost() const { return state_->lost; }
void Session::when_lost(std::function<void()> call) { state_->on_lost = std::move(call); }

asio::awaitable<Answer<std::unique_ptr<Session>>> Session::connect(
    std::string server, ConnectLimits limits, std::optional<Credentials> known) {
  const auto endpoint = wire::parse_endpoint(server);
  if (!endpoint) co_return session_error(Kind::input, endpoint.error().message);
  if (!known) {
    const auto kept = kept_credentials(wire::to_string(*endpoint));
    if (!kept) co_return session_error(Kind::input, kept.error().message);
    known = *kept;
  }
  Answer<std::unique_ptr<wire::Stream>> stream;
  try {
    stream = co_await reach(*endpoint, *known, limits);
  } catch (const boost::system::system_error& error) {
    if (error.code() != asio::error::operation_aborted) throw;
    co_return session_error(
        Kind::no_server, "can't connect to " + wire::to_string(*endpoint) + ": Operation canceled");
  }
  if (!stream) co_return tl::unexpected<SessionError>(std::move(stream.error()));

  const auto executor = co_await asio::this_coro::executor;
  auto state = std::make_shared<State>(*std::move(stream), wire::to_string(*endpoint));
  asio::co_spawn(executor, State::read_all(state), asio::detached);
  std::unique_ptr<Session> session(new Session(state));

  // Give up the handshake after its time, or when this coroutine is cancelled.
  asio::steady_timer timer(executor, limits.welcome);
  timer.async_wait([state](error_code cancelled) {
    if (!cancelled) state->lose("it did not answer the handshake");
  });
  Answer<void> greeted;
  try {
    greeted = co_await session->shake_hands(known->token);
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

asio::awaitable<Answer<void>> Session::shake_hands(const std::string& token) {
  v1::Envelope request;
  request.mutable_hello()->set_protocol_version(wire::protocol_version);
  request.mutable_hello()->set_client(std::string("metamer ") + METAMER_VERSION);
  request.mutable_hello()->set_token(token);
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

asio::awaitable<Answer<v1::JobList>> Session::list(bool mine) {
  v1::JobList all;
  std::uint64_t last = 0;
  for (bool more = true; more;) {
    v1::Envelope request;
    request.mutable_list_jobs()->set_mine(mine);
    request.mutable_list_jobs()->set_after(last);
    Answer<v1::Envelope> answer = co_await ask(std::move(request));
    if (!answer) co_return tl::unexpected<SessionError>(std::move(answer.error()));
    if (!answer->has_job_list()) co_return unexpected_answer();
    const v1::JobList& page = answer->job_list();
    // Its numbers rise, or it would have no end.
    more = page.more() && page.job_size() > 0 && page.job().rbegin()->job_id() > last;
    if (more) last = page.job().rbegin()->job_id();
    all.mutable_job()->MergeFrom(page.job());
  }
  co_return all;
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

asio::awaitable<Answer<v1::JobSummary>> Session::prioritize(std::uint64_t job_id,
                                                            std::int32_t priority) {
  v1::Envelope request;
  request.mutable_prioritize()->set_job_id(job_id);
  request.mutable_prioritize()->set_priority(priority);
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

/// The job's events until its last one. False when it was stopped before that.
asio::awaitable<Answer<bool>> Session::follow(Exchange& exchange, v1::Watch request,
                                              const OnEvent& on_event, std::stop_token stop) {
  const std::stop_callback stopped(stop, [&] { exchange.close(); });
  v1::Envelope envelope;
  envelope.set_request_id(exchange.id());
  *envelope.mutable_watch() = std::move(request);
  co_await state_->write(envelope);

  while (true) {
    Answer<v1::Envelope> answer = co_await exchange.receive();
    if (stop.stop_requested()) co_return false;
    if (!answer) co_return tl::unexpected<SessionError>(std::move(answer.error()));
    if (!answer->has_job_event()) co_return unexpected_answer();
    const v1::JobEvent& event = answer->job_event();
    Answer<void> taken = on_event(event);
    if (!taken) co_return tl::unexpected<SessionError>(std::move(taken.error()));
    if (event.has_finished() || event.has_failed() || event.has_cancelled()) co_return true;
  }
}

asio::awaitable<Answer<void>> Session::watch(v1::Watch request, OnEvent on_event,
                                             std::stop_token stop) {
  std::uint64_t id = 0;
  Answer<bool> ended;
  {
    Exchange exchange(state_);
    id = exchange.id();
    ended = co_await follow(exchange, std::move(request), on_event, stop);
  }
  if (!ended || !*ended) {
    // Nobody waits for the answer: the next request is read after this one.
    v1::Envelope envelope;
    envelope.set_request_id(++state_->last_id);
    envelope.mutable_unwatch()->set_watch(id);
    co_await state_->write(envelope);
  }
  if (!ended) co_return tl::unexpected<SessionError>(std::move(ended.error()));
  co_return Answer<void>();
}

}  // namespace metamer::client
