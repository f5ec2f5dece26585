#include "client/session/live_view.h"

#include <algorithm>
#include <boost/asio/co_spawn.hpp>
#include <boost/asio/detached.hpp>
#include <boost/asio/redirect_error.hpp>
#include <boost/asio/use_awaitable.hpp>
#include <utility>

#include "client/session/restart_limit.h"

namespace metamer::client {

namespace asio = boost::asio;

LiveView::LiveView(asio::any_io_executor executor, Submission submission, ViewHooks hooks)
    : hooks_(std::move(hooks)),
      signal_(std::move(executor), asio::steady_timer::time_point::max()),
      scene_(std::move(submission)) {}

void LiveView::lose(const SessionError& error) {
  if (closing_) return;
  close();
  if (hooks_.lost) hooks_.lost(error);
}

void LiveView::wake() { signal_.cancel(); }

bool LiveView::wants_frame() const {
  if (paused_ || static_cast<int>(asked_.size()) + waiting_ >= most_frames) return false;
  return !complete_ || xyz_due_;
}

void LiveView::change(SceneChange change) {
  merge(std::move(change), pending_);
  if (!sending_ && view_ && !closing_)
    asio::co_spawn(signal_.get_executor(), send_pending(), asio::detached);
}

/// One change at a time: the next one goes out when a frame shows this one, or it is refused.
asio::awaitable<void> LiveView::send_pending() {
  const auto self = shared_from_this();
  if (is_too_old()) end_view();  // and it is opened anew
  if (sending_ || pending_.empty() || ending_ || !view_) co_return;
  co_await send(std::exchange(pending_, {}));
}

asio::awaitable<void> LiveView::send(SceneChange change) {
  const auto view = view_;
  sending_ = true;
  complete_ = false;
  sent_ = change;
  change.rest.set_revision(++revision_);
  Answer<void> sent;
  if (change.scene)
    sent = co_await view->replace(*change.scene, revision_, change.rest, change.files);
  else
    sent = co_await view->update(change.rest, change.files);
  // A file that can't be sent; a lost session ends the frames, too.
  if (!sent && view == view_ && !view->lost()) refuse(sent.error());
  wake();
}

void LiveView::refuse(const SessionError& error) {
  sending_ = false;
  sent_ = {};
  if (hooks_.refused && !closing_) hooks_.refused(error);
}

/// A frame shows what was sent.
void LiveView::accept() {
  sending_ = false;
  if (sent_.scene && !view_->updated().has_plan()) {
    replaces_ = false;
    merge(std::exchange(pending_, {}), sent_);
    pending_ = std::exchange(sent_, {});
    return;
  }
  if (sent_.scene) {
    scene_ = *std::exchange(sent_.scene, std::nullopt);
    since_ = {};
  }
  merge(std::exchange(sent_, {}), since_);
}

void LiveView::taken() {
  waiting_ = std::max(0, waiting_ - 1);
  wake();
}

void LiveView::probe(const ViewPlace& place) {
  place_ = place;
  if (!probing_ && view_ && !closing_)
    asio::co_spawn(signal_.get_executor(), send_probes(), asio::detached);
}

/// That the view is lost is run()'s to say.
asio::awaitable<void> LiveView::send_probes() {
  const auto self = shared_from_this();
  probing_ = true;
  while (place_ && view_ && !closing_) {
    const auto view = view_;
    const ViewPlace place = *std::exchange(place_, std::nullopt);
    Answer<v1::Probed> probed = co_await view->probe(place.x, place.y, place.side);
    const bool said =
        probed || (probed.error().kind == SessionError::Kind::refused && !view->lost());
    if (said && !closing_ && hooks_.probed) hooks_.probed(place, std::move(probed));
  }
  probing_ = false;
}

void LiveView::want_xyz(bool wanted) {
  xyz_due_ = wanted && (xyz_due_ || !xyz_);
  xyz_ = wanted;
  wake();
}

void LiveView::pause(bool paused) {
  paused_ = paused;
  wake();
}

void LiveView::close() {
  closing_ = true;
  end_view();
}

/// Frames that were asked for may never come: the server is told at once, and draw() ends with the
/// view.
void LiveView::end_view() {
  if (!view_ || std::exchange(ending_, true)) return;
  asio::co_spawn(signal_.get_executor(), close_view(view_), asio::detached);
  wake();
}

asio::awaitable<void> LiveView::close_view(std::shared_ptr<View> view) {
  const auto self = shared_from_this();
  if (!view->lost()) (void)co_await view->close();
}

/// Waits for a frame that was asked for, or for the view's end.
asio::awaitable<void> LiveView::show_next() {
  Answer<View::Picture> picture = co_await view_->next();
  if (!picture && view_->lost()) co_return;
  if (!picture) {
    // Beside refusals of a change: the server's objection to something that it was asked.
    if (picture.error().kind == SessionError::Kind::input)
      refuse(picture.error());
    else
      lose(picture.error());
    co_return;
  }
  const bool asked_xyz = asked_.front();
  asked_.pop_front();
  if (picture->frame.revision() == revision_) {
    if (sending_) accept();
    complete_ = picture->frame.complete();
    // One that was asked for before X Y Z were wanted may come later.
    if (complete_ && asked_xyz) xyz_due_ = false;
  }
  if (ending_) co_return;
  ++waiting_;
  if (hooks_.frame)
    hooks_.frame({.width = picture->width,
                  .height = picture->height,
                  .rgb = std::move(picture->rgb),
                  .xyz = std::move(picture->xyz),
                  .newest = !sending_ && pending_.empty(),
                  .frame = std::move(picture->frame),
                  .plan = view_->plan()});
}

/// A view that rests may be lost, too.
asio::awaitable<void> LiveView::watch_over(std::shared_ptr<View> view) {
  const auto self = shared_from_this();
  co_await view->until_lost();
  wake();
}

/// The view was opened, with the scene alone.
void LiveView::begin(std::unique_ptr<View> view) {
  view_ = std::move(view);
  revision_ = 0;
  asked_.clear();
  sending_ = complete_ = ending_ = false;
  xyz_due_ = xyz_;
  SceneChange unsure = std::exchange(sent_, {});
  merge(std::exchange(pending_, {}), unsure);
  pending_ = std::move(unsure);
  asio::co_spawn(signal_.get_executor(), watch_over(view_), asio::detached);
  if (closing_) return end_view();
  if (hooks_.opened) hooks_.opened(view_->plan());
  if (place_) probe(*place_);
}

/// Draws until the view is lost or closed.
asio::awaitable<void> LiveView::draw() {
  if (!since_.empty() && !ending_) co_await send(std::exchange(since_, {}));
  while (!view_->lost()) {
    co_await send_pending();
    while (!ending_ && wants_frame()) {
      asked_.push_back(xyz_);
      co_await view_->ask(xyz_);
    }
    if (!asked_.empty() || ending_) {
      co_await show_next();
    } else {
      boost::system::error_code ignored;
      signal_.expires_at(asio::steady_timer::time_point::max());
      co_await signal_.async_wait(asio::redirect_error(asio::use_awaitable, ignored));
    }
  }
}

asio::awaitable<void> LiveView::run(Session& session) {
  const auto self = shared_from_this();
  RestartLimit reopened;
  while (!closing_) {
    Answer<std::unique_ptr<View>> opened = co_await View::open(session, scene_);
    if (!opened) co_return lose(opened.error());
    begin(std::move(*opened));
    co_await draw();
    const auto view = std::exchange(view_, nullptr);
    if (closing_) co_return;
    if (is_too_old()) {
      scene_ = *std::exchange(pending_.scene, std::nullopt);
      since_ = {};
    } else if (view->worker_lost() && reopened.take(RestartLimit::Clock::now())) {
      if (hooks_.interrupted) hooks_.interrupted(*view->lost());
    } else {
      co_return lose(*view->lost());
    }
  }
}

}  // namespace metamer::client
