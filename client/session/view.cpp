#include "client/session/view.h"

#include <algorithm>

#include "client/session/exchange.h"
#include "common/scene/limits.h"

namespace metamer::client {
namespace {

using Kind = SessionError::Kind;

tl::unexpected<SessionError> failure(const v1::Failed& failed) {
  SessionError error;
  error.kind = failed.kind() == v1::Failed::BAD_INPUT ? Kind::input : Kind::refused;
  error.message = failed.reason().empty() ? "the server closed the view" : failed.reason();
  error.problems.assign(failed.problem().begin(), failed.problem().end());
  return tl::unexpected<SessionError>(std::move(error));
}

/// Adds a band to a picture. False: it does not continue it.
bool add(const v1::FrameBand& band, View::Picture& to) {
  const std::size_t row = std::size_t{3} * band.width();
  if (band.first_row() == 0) {
    if (row == 0 || std::uint64_t{band.width()} * band.height() > limits::max_view_pixels)
      return false;
    to.width = band.width();
    to.height = band.height();
    to.rgb.clear();
  }
  if (band.width() != to.width || band.height() != to.height ||
      band.first_row() * row != to.rgb.size() ||
      to.rgb.size() + band.rgb().size() > row * to.height)
    return false;
  to.rgb.insert(to.rgb.end(), band.rgb().begin(), band.rgb().end());
  to.frame = band.frame();
  return !band.has_frame() || to.rgb.size() == row * to.height;
}

}  // namespace

View::View(Session& session, std::unique_ptr<Session::Exchange> exchange)
    : session_(session), exchange_(std::move(exchange)) {}

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
  const v1::ViewEvent& event = answer->view_event();
  if (event.has_closed()) co_return failure(event.closed().reason());
  if (!event.has_updated()) co_return unexpected_answer();
  view->id_ = event.view_id();
  view->plan_ = event.updated().plan();
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

asio::awaitable<void> View::ask() {
  v1::Envelope request;
  request.mutable_next_frame()->set_view_id(id_);
  co_await send(std::move(request));
}

asio::awaitable<Answer<void>> View::close() {
  v1::Envelope request;
  request.mutable_close_view()->set_view_id(id_);
  co_await send(std::move(request));
  while (true) {
    const Answer<v1::Envelope> answer = co_await exchange_->receive();
    if (!answer) co_return tl::unexpected<SessionError>(answer.error());
    if (answer->view_event().has_closed()) co_return Answer<void>();
  }
}

asio::awaitable<Answer<View::Picture>> View::next() {
  while (true) {
    Answer<v1::Envelope> answer = co_await exchange_->receive();
    if (!answer) co_return tl::unexpected<SessionError>(std::move(answer.error()));
    const v1::ViewEvent& event = answer->view_event();
    switch (event.event_case()) {
      case v1::ViewEvent::kUpdated:
        if (event.updated().has_plan()) plan_ = event.updated().plan();
        break;
      case v1::ViewEvent::kRefused: {
        v1::Failed failed;
        failed.set_kind(v1::Failed::BAD_INPUT);
        failed.set_reason("the change was refused");
        *failed.mutable_problem() = event.refused().problem();
        co_return failure(failed);
      }
      case v1::ViewEvent::kBand:
        if (!add(event.band(), picture_)) co_return unexpected_answer();
        if (event.band().has_frame()) co_return std::move(picture_);
        break;
      case v1::ViewEvent::kClosed:
        co_return failure(event.closed().reason());
      case v1::ViewEvent::EVENT_NOT_SET:
        co_return unexpected_answer();
    }
  }
}

}  // namespace metamer::client
