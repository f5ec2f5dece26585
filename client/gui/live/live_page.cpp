#include "client/gui/live/live_page.h"

#include <QVBoxLayout>
#include <algorithm>
#include <cmath>
#include <utility>

#include "client/gui/live/camera_axes.h"
#include "client/session/problems.h"
#include "client/session/submission.h"
#include "client/tools/scene/camera_motion.h"
#include "client/tools/scene/view_change.h"
#include "common/scene/methods.h"

namespace metamer::gui {
namespace {

constexpr int old_frame = 300;  // ms: from then on the age of a frame is told

bool same_files(const std::vector<Asset>& some, const std::vector<Asset>& others) {
  return std::ranges::equal(some, others, [](const Asset& one, const Asset& other) {
    return one.name == other.name && one.sha256 == other.sha256;
  });
}

}  // namespace

LivePage::LivePage(Link& link, Document& document, QWidget* parent)
    : PicturePage(parent), link_(link), document_(document), canvas_(new Canvas(this)) {
  auto* layout = new QVBoxLayout(this);
  layout->setContentsMargins(0, 0, 0, 0);
  layout->addWidget(canvas_);
  setFocusProxy(canvas_);
  set_subject(&document_);
  connect(&document_, &Document::checked_changed, this, &LivePage::follow);
  connect(&document_, &Document::look_changed, this, &LivePage::follow);
  connect(&document_, &Document::camera_changed, this, &LivePage::follow_camera);
  connect(&link_, &Link::status_changed, this, &LivePage::follow);
  connect(canvas_, &Canvas::resized, this, &LivePage::follow);
  connect(canvas_, &Canvas::xyz_wanted, this, &LivePage::ask_xyz);
  connect(canvas_, &Canvas::view_changed, this, &LivePage::ask_xyz);
  connect(canvas_, &Canvas::painted, this, [this] {
    if (view_ != nullptr && std::exchange(taken_due_, false)) view_->taken();
  });
  connect(canvas_, &Canvas::dragged, this, &LivePage::drag);
  connect(canvas_, &Canvas::wheeled, this, [this](double steps) {
    if (live_) set_camera(client::dolly(camera(), std::pow(0.9, steps)));
  });
  age_.setInterval(old_frame / 2);
  connect(&age_, &QTimer::timeout, this, &LivePage::update_overlay);
}

/// A live view is as large as the widget, within the server's limit; a picture's shape is the
/// scene's.
v1::Scene LivePage::sized(v1::Scene scene) const {
  const v1::Settings& settings = scene.settings();
  const double wide = settings.has_width() ? settings.width() : 640;
  const double high = settings.has_height() ? settings.height() : 480;
  const QSize room = canvas_->device_size();
  double factor = std::min(room.width() / wide, room.height() / high);
  const double most = static_cast<double>(link_.status().welcome.limits().view_pixels());
  if (most > 0) factor = std::min(factor, std::sqrt(most / (wide * high)));
  if (!(factor > 0)) return scene;
  scene.mutable_settings()->set_width(
      static_cast<std::uint32_t>(std::max(1.0, std::floor(wide * factor))));
  scene.mutable_settings()->set_height(
      static_cast<std::uint32_t>(std::max(1.0, std::floor(high * factor))));
  return scene;
}

void LivePage::follow() {
  if (!live_) return;
  if (!link_.ready()) {
    if (view_ != nullptr) {
      delete std::exchange(view_, nullptr);
      canvas_->set_stale(tr("old: there is no server"));
    }
    return;
  }
  Result<v1::Scene> scene = document_.effective();
  if (!scene) {
    Q_EMIT troubled(QString::fromStdString(scene.error().message));
    return;
  }
  const auto checked = document_.checked();
  Q_EMIT troubled(checked && checked->sound()
                      ? QString()
                      : tr("the scene has problems: it is shown as it was"));
  if (method_) {
    scene->mutable_settings()->clear_goal();
    *scene->mutable_settings()->mutable_method() = *method_;
  }
  const v1::Scene wanted = sized(std::move(*scene));
  if (view_ == nullptr || wanted.settings().backend() != shown_.settings().backend())
    return open_view(wanted);
  std::optional<v1::UpdateView> change;
  if (same_files(document_.sound()->assets(), shown_files_))
    change = client::view_change(shown_, wanted);
  if (change && change->ByteSizeLong() == 0) return;
  document_.set_server_problems({});
  if (change) {
    shown_ = wanted;
    view_->change(*change);
  } else {
    view_->replace(submission(wanted));
  }
  wait_for_frame();
}

/// A hand moves the camera many times a second: nothing is made anew that depends on the scene's
/// size.
void LivePage::follow_camera() {
  if (!live_ || !link_.ready() || view_ == nullptr) return follow();
  v1::UpdateView change;
  *change.mutable_camera() = document_.seen_camera();
  *shown_.mutable_camera() = change.camera();
  document_.set_server_problems({});
  view_->change(std::move(change));
  wait_for_frame();
}

/// That is shown from now on.
client::Submission LivePage::submission(const v1::Scene& scene) {
  shown_ = scene;
  shown_files_ = document_.sound()->assets();
  return client::make_submission(scene, shown_files_, document_.sound()->name(), false);
}

void LivePage::open_view(const v1::Scene& scene) {
  delete view_;
  document_.set_server_problems({});
  taken_due_ = false;
  view_ = new RemoteView(link_, submission(scene), this);
  connect(view_, &RemoteView::frame, this, &LivePage::take);
  connect(view_, &RemoteView::refused, this, [this](const auto& error) {
    document_.set_server_problems(client::from_wire(error->problems));
    Q_EMIT troubled(QString::fromStdString(error->message));
  });
  connect(view_, &RemoteView::interrupted, this, [this](const auto& error) {
    canvas_->set_stale(tr("old: %1; opened anew").arg(QString::fromStdString(error->message)));
  });
  connect(view_, &RemoteView::lost, this, [this](const auto& error) { lose(*error); });
  connect(view_, &RemoteView::probed, this, &LivePage::probed);
  connect(view_, &RemoteView::not_probed, this, &LivePage::not_probed);
  ask_xyz();
  wait_for_frame();
}

/// Frames are of 8 bits while it moves; what is to be seen of X Y Z comes with a complete one.
void LivePage::show_frame() {
  const Developing developing = developing_of(&frame_->plan);
  const auto xyz = given_ ? given_->xyz : frame_->xyz;
  if (xyz && canvas_->wants_xyz())
    canvas_->set_picture({xyz, developing});
  else
    canvas_->set_image(frame_->image, color_space(developing));
}

void LivePage::ask_xyz() {
  if (canvas_->wants_xyz() && given_ && qobject_cast<const ImageLayer*>(canvas_->layer()))
    show_frame();
  if (view_ != nullptr) view_->want_xyz(!waiting_.isEmpty() || canvas_->wants_xyz());
}

void LivePage::wait_for_frame() {
  if (!due_.isValid()) due_.start();
  age_.start();
}

std::optional<client::ViewPlace> LivePage::probe(const QPoint& pixel, int side) {
  if (view_ == nullptr || !frame_) return std::nullopt;
  // A pixel of a coarse frame stands for several.
  const auto whole = [](int at, std::uint32_t size, int shown) {
    return static_cast<std::uint32_t>((at + 0.5) * size / std::max(1, shown));
  };
  const client::ViewPlace place{
      .x = whole(pixel.x(), frame_->plan.width(), frame_->image.width()),
      .y = whole(pixel.y(), frame_->plan.height(), frame_->image.height()),
      .side = static_cast<std::uint32_t>(side)};
  view_->probe(place);
  return place;
}

void LivePage::take(const std::shared_ptr<const LiveFrame>& frame) {
  frame_ = frame;
  taken_due_ = true;
  if (since_.isValid()) {
    const double seconds = static_cast<double>(since_.nsecsElapsed()) * 1e-9;
    rate_ = seconds > 1 ? 1 / seconds : 0.8 * rate_ + 0.2 / std::max(seconds, 1e-3);
  }
  since_.start();
  if (frame->newest) {
    due_.invalidate();
    age_.stop();
  }
  given_.reset();
  show_frame();
  canvas_->set_axes(info_ ? camera_axes(shown_.camera()) : std::nullopt);
  update_overlay();
  if (frame->xyz) give(*frame);
  go_on_unseen();
  Q_EMIT framed();
}

QString LivePage::picture_title() const {
  return frame_ ? tr("Live: %1").arg(document_.title()) : QString();
}

void LivePage::hand_over(std::function<void(const Picture&)> to) {
  // A server sends the X Y Z of one frame once.
  if (given_) return to(*given_);
  waiting_ << std::move(to);
  if (view_ == nullptr) return;
  ask_xyz();
  go_on_unseen();
}

/// Behind another tab nothing is painted, which would be what asks for the next frame.
void LivePage::go_on_unseen() {
  if (waiting_.isEmpty() || canvas_->isVisible()) return;
  if (std::exchange(taken_due_, false)) view_->taken();
}

/// A frame with its X Y Z to those who wait for one.
void LivePage::give(const LiveFrame& frame) {
  given_ = Picture{.title = picture_title(),
                   .from = document_.title(),
                   .xyz = frame.xyz,
                   .plan = std::make_shared<const v1::Plan>(frame.plan)};
  for (const auto& to : std::exchange(waiting_, {})) to(*given_);
  ask_xyz();
}

void LivePage::lose(const client::SessionError& error) {
  document_.set_server_problems(client::from_wire(error.problems));
  view_->deleteLater();
  view_ = nullptr;
  canvas_->set_stale(tr("old: %1").arg(QString::fromStdString(error.message)));
  Q_EMIT troubled(QString::fromStdString(error.message));
}

void LivePage::update_overlay() {
  if (!info_ || !frame_) return canvas_->set_overlay({});
  const v1::Frame& frame = frame_->frame;
  const v1::Plan& plan = frame_->plan;
  QStringList lines;
  lines << tr("%1 · %2 · %3 fps · %4/%5 samples · %6 ms")
               .arg(QString::fromStdString(method_text(plan.method())),
                    QString::fromStdString(plan.backend()).toUpper())
               .arg(rate_, 0, 'f', rate_ < 10 ? 1 : 0)
               .arg(frame.samples())
               .arg(plan.spp())
               .arg(1000 * (frame.render() + frame.develop()), 0, 'f', 1);
  if (due_.isValid() && due_.elapsed() > old_frame)
    lines << tr("%1 s old").arg(static_cast<double>(due_.elapsed()) / 1000, 0, 'f', 1);
  if (frame.out_of_gamut() > 0) lines << tr("%L1 pixels out of gamut").arg(frame.out_of_gamut());
  canvas_->set_overlay(lines);
}

void LivePage::show_info(bool shown) {
  info_ = shown;
  canvas_->set_axes(info_ ? camera_axes(shown_.camera()) : std::nullopt);
  update_overlay();
}

void LivePage::show_by(const std::optional<v1::Method>& method) {
  method_ = method;
  follow();
}

void LivePage::set_live(bool live) {
  live_ = live;
  if (view_ != nullptr) view_->pause(!live);
  if (!live) age_.stop();
  if (live) follow();
}

v1::Camera LivePage::camera() const { return document_.seen_camera(); }

void LivePage::set_camera(const v1::Camera& camera) { document_.set_camera(camera); }

void LivePage::home() { document_.set_camera(std::nullopt); }

/// The left button turns, with Shift or the middle one it shifts, the right one comes nearer.
void LivePage::drag(const QPointF& by, Qt::MouseButton button, Qt::KeyboardModifiers modifiers) {
  if (!live_ || !document_.sound()) return;
  const double high = std::max(1, canvas_->height());
  if (button == Qt::MiddleButton ||
      (button == Qt::LeftButton && modifiers.testFlag(Qt::ShiftModifier)))
    set_camera(client::pan(camera(), -by.x() / high, by.y() / high));
  else if (button == Qt::LeftButton)
    set_camera(client::elevate(client::orbit(camera(), -180 * by.x() / high), 180 * by.y() / high));
  else
    set_camera(client::dolly(camera(), std::exp(by.y() / high)));
}

}  // namespace metamer::gui
