#include "client/session/view.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "client/session/exchange.h"
#include "common/scene/limits.h"
#include "common/scene/probed.h"

namespace metamer::client {
namespace {

using Kind = SessionError::Kind;

/// Frames, refusals and errors that nobody has fetched; more is no server of this protocol.
constexpr std::size_t max_arrived = 256;

SessionError failure_of(const v1::Failed& failed) {
  SessionError error;
  error.kind = failed.kind() == v1::Failed::BAD_INPUT ? Kind::input : Kind::refused;
  error.message = failed.reason().empty() ? "the server closed the view" : failed.reason();
  error.problems.assign(failed.problem().begin(), failed.problem().end());
  return error;
}

/// Adds a band to a picture. False: it does not continue it.
bool add(const v1::FrameBand& band, View::Picture& to) {
  static_assert(std::endian::native == std::endian::little, "X Y Z are little-endian");
  const std::size_t row = std::size_t{3} * band.width();
  if (band.first_row() == 0) {
    if (row == 0 || std::uint64_t{band.width()} * band.height() > limits::max_view_pixels)
      return false;
    to.width = band.width();
    to.height = band.height();
    to.rgb.clear();
    to.xyz.clear();
  }
  // All bands have X Y Z, or none.
  const bool has_xyz = band.first_row() == 0 ? !band.xyz().empty() : !to.xyz.empty();
  if (band.width() != to.width || band.height() != to.height ||
      band.first_row() * row != to.rgb.size() ||
      to.rgb.size() + band.rgb().size() > row * to.height ||
      band.xyz().size() != (has_xyz ? band.rgb().size() * sizeof(float) : 0))
    return false;
  to.rgb.insert(to.rgb.end(), band.rgb().begin(), band.rgb().end());
  const std::size_t before = to.xyz.size();
  to.xyz.resize(before + band.xyz().size() / sizeof(float));
  std::memcpy(to.xyz.data() + before, band.xyz().data(), band.xyz().size());
  to.frame = band.frame();
  return !band.has_frame() || to.rgb.size() == row * to.height;
}

}  // namespace

/// Cancelled when something has come.
struct View::Changed {
  asio::steady_timer timer;
};

View::View(Session& session, std::unique_ptr<Session::Exchange> exchange)
    : session_(session),
      exchange_(std::move(exchange)),
      changed_(new Changed{asio::steady_timer(session.state_->channel.executor(),
                                              asio::steady_timer::time_point::max())}) {}

View::~View() = default;

asio::awaitable<Answer<std::unique_ptr<View>>> View::open(Session& session,
                                                          const Submission& submission) {
  Answer<void> sent = co_await session.send_missing(submission.uploads);
  if (!sent) co_return tl::unexpected<SessionError>(std::move(sent.error()));
  std::unique_ptr<View> view(
      new View(session, std::make_unique<Session::Exchange>(session.state_)));
  v1::Envelope request;
  request.set_request_id(view->exchange_->id());
  v1::OpenView& open = *request.mutable_open_view();
  open.set_scene_sha256(submission.request.scene_sha256());
  *open.mutable_asset() = submission.request.asset();
  open.set_backend(submission.request.backend());
  co_await session.state_->write(request);

  Answer<v1::Envelope> answer = co_await view->exchange_->receive();
  if (!answer) co_return tl::unexpected<SessionError>(std::move(answer.error()));
  v1::ViewEvent& event = *answer->mutable_view_event();
  if (event.has_closed())
    co_return tl::unexpected<SessionError>(failure_of(event.closed().reason()));
  if (!event.has_updated()) co_return unexpected_answer();
  view->id_ = event.view_id();
  view->take_event(event);
  co_return Answer<std::unique_ptr<View>>(std::move(view));
}

/// Under the number of the view's own request: so what the server objects to comes by next().
asio::awaitable<void> View::send(v1::Envelope request) {
  request.set_request_id(exchange_->id());
  co_await session_.state_->write(request);
}

asio::awaitable<Answer<void>> View::update(v1::UpdateView change,
                                           const std::vector<Upload>& files) {
  Answer<void> sent = co_await session_.send_missing(files);
  if (!sent) co_return sent;
  for (const Upload& file : files) {
    v1::AssetName& asset = *change.add_asset();
    asset.set_name(file.name);
    asset.set_sha256(std::string(to_bytes(file.sha256)));
  }
  v1::Envelope request;
  change.set_view_id(id_);
  *request.mutable_update_view() = std::move(change);
  co_await send(std::move(request));
  co_return Answer<void>();
}

asio::awaitable<Answer<void>> View::replace(const Submission& submission, std::uint64_t revision,
                                            v1::UpdateView change,
                                            const std::vector<Upload>& files) {
  Answer<void> sent = co_await session_.send_missing(submission.uploads);
  if (!sent) co_return sent;
  change.set_revision(revision);
  change.set_scene_sha256(submission.request.scene_sha256());
  auto assets = submission.request.asset();
  assets.MergeFrom(change.asset());
  *change.mutable_asset() = std::move(assets);
  co_return co_await update(std::move(change), files);
}

asio::awaitable<void> View::ask(bool xyz) {
  v1::Envelope request;
  request.mutable_next_frame()->set_view_id(id_);
  request.mutable_next_frame()->set_xyz(xyz);
  ++coming_;
  co_await send(std::move(request));
}

asio::awaitable<Answer<void>> View::close() {
  v1::Envelope request;
  request.mutable_close_view()->set_view_id(id_);
  co_await send(std::move(request));
  co_await read_until([this] { return closed_; });
  if (!closed_) co_return tl::unexpected<SessionError>(*lost_);
  co_return Answer<void>();
}

asio::awaitable<void> View::until_lost() {
  co_await read_until([] { return false; });
}

asio::awaitable<Answer<View::Picture>> View::next() {
  co_await read_until([this] { return !arrived_.empty(); });
  if (arrived_.empty()) co_return tl::unexpected<SessionError>(*lost_);
  Answer<Picture> arrived = std::move(arrived_.front());
  arrived_.pop_front();
  co_return arrived;
}

/// Under a number of its own, by which the server answers or says what it objects to.
asio::awaitable<Answer<v1::Probed>> View::probe(std::uint32_t x, std::uint32_t y,
                                                std::uint32_t side) {
  const std::uint64_t number = exchange_->add_request();
  v1::Envelope request;
  request.set_request_id(number);
  v1::Probe& probe = *request.mutable_probe();
  probe.set_view_id(id_);
  probe.set_number(number);
  probe.set_x(x);
  probe.set_y(y);
  probe.set_side(side);
  struct Own {  // also where the coroutine is cancelled
    View& view;
    std::uint64_t number;
    std::optional<Answer<v1::Probed>>& answer = view.probes_[number];
    ~Own() {
      view.exchange_->forget_request(number);
      view.probes_.erase(number);
    }
  } const own{*this, number};
  co_await session_.state_->write(request);
  co_await read_until([&] { return own.answer.has_value(); });
  if (!own.answer) co_return tl::unexpected<SessionError>(*lost_);
  co_return *std::move(own.answer);
}

/// Returns once `ready`, or when the view is lost. One coroutine reads at a time, for all.
asio::awaitable<void> View::read_until(std::function<bool()> ready) {
  struct Reading {  // also where the coroutine is cancelled
    View& view;
    explicit Reading(View& of) : view(of) { view.reading_ = true; }
    ~Reading() {
      view.reading_ = false;
      view.changed_->timer.cancel();
    }
  };
  while (!ready() && !lost_) {
    if (reading_) {
      co_await changed_->timer.async_wait(asio::as_tuple(asio::use_awaitable));
      continue;
    }
    const Reading reading(*this);
    take(co_await exchange_->receive_any());
  }
}

void View::lose(SessionError error) {
  if (!lost_) lost_ = std::move(error);
}

void View::take(Answer<v1::Envelope> answer) {
  if (!answer) return lose(std::move(answer.error()));
  if (answer->has_error()) {
    const auto probe = probes_.find(answer->request_id());
    auto error = refused(answer->error());
    if (probe != probes_.end())
      probe->second = std::move(error);
    else
      arrived_.emplace_back(std::move(error));
  } else {
    take_event(*answer->mutable_view_event());
  }
  if (arrived_.size() > max_arrived) lose(unexpected_answer().value());
}

void View::take_event(v1::ViewEvent& event) {
  switch (event.event_case()) {
    case v1::ViewEvent::kUpdated:
      updated_ = std::move(*event.mutable_updated());
      if (updated_.has_plan()) plan_ = updated_.plan();
      return;
    case v1::ViewEvent::kRefused: {
      v1::Failed failed;
      failed.set_kind(v1::Failed::BAD_INPUT);
      failed.set_reason("the change was refused");
      *failed.mutable_problem() = event.refused().problem();
      arrived_.emplace_back(tl::unexpected<SessionError>(failure_of(failed)));
      return;
    }
    case v1::ViewEvent::kBand:
      return take_band(event.band());
    case v1::ViewEvent::kProbed:
      return take_probed(std::move(*event.mutable_probed()));
    case v1::ViewEvent::kClosed:
      closed_ = true;
      worker_lost_ = event.closed().reason().kind() == v1::Failed::WORKER;
      return lose(failure_of(event.closed().reason()));
    case v1::ViewEvent::EVENT_NOT_SET:
      return lose(unexpected_answer().value());
  }
}

void View::take_band(const v1::FrameBand& band) {
  if (coming_ == 0 || !add(band, picture_)) return lose(unexpected_answer().value());
  if (!band.has_frame()) return;
  --coming_;
  arrived_.emplace_back(std::exchange(picture_, {}));
}

/// Answers come in the order of their questions; what lies before has given way.
void View::take_probed(v1::Probed probed) {
  const auto own = probes_.find(probed.number());
  if (!is_sound(probed)) return lose(unexpected_answer().value());
  if (own == probes_.end()) return;  // nobody waits for it any more
  for (auto older = probes_.begin(); older != own; ++older)
    if (!older->second)
      older->second = session_error(Kind::refused, "newer probes took the turn of this one");
  own->second = std::move(probed);
}

}  // namespace metamer::client
