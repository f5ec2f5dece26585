#include "client/gui/picture/canvas.h"

#include <QMouseEvent>
#include <QPainter>
#include <QWheelEvent>
#include <algorithm>
#include <cmath>
#include <utility>

namespace metamer::gui {
namespace {

const QColor surround(119, 119, 119);  // sRGB of L* 50: neutral in light and dark themes

/// What stands over a picture, for those who can't see it.
QString sentence_of(const QSize& picture, QStringList lines, const QString& stale) {
  if (!stale.isEmpty()) lines.prepend(stale);
  lines.prepend(picture.isEmpty()
                    ? Canvas::tr("No picture yet")
                    : Canvas::tr("%1 by %2 pixels").arg(picture.width()).arg(picture.height()));
  return lines.join(QStringLiteral("; "));
}

}  // namespace

Canvas::Canvas(QWidget* parent) : QWidget(parent) {
  setFocusPolicy(Qt::StrongFocus);
  setMouseTracking(true);
  setMinimumSize(160, 120);
  setAttribute(Qt::WA_OpaquePaintEvent);
  setAccessibleName(tr("Picture"));
  setAccessibleDescription(sentence_of(picture_size(), overlay_, stale_));
}

/// A layer that is repainted when it has more to show, and looked at as the others are.
std::unique_ptr<PictureLayer> Canvas::followed(std::unique_ptr<PictureLayer> layer) {
  layer->set_viewing(viewing_);
  connect(layer.get(), &PictureLayer::changed, this, qOverload<>(&Canvas::update));
  return layer;
}

void Canvas::set_layer(std::unique_ptr<PictureLayer> layer) {
  const QSize before = picture_size();
  layer_ = layer ? followed(std::move(layer)) : nullptr;
  if (before != picture_size()) centre_ = middle();
  const bool other = before != picture_size() || !stale_.isEmpty();
  stale_.clear();
  if (other) setAccessibleDescription(sentence_of(picture_size(), overlay_, stale_));
  update();
}

void Canvas::set_image(const QImage& image, const QColorSpace& space) {
  set_image(image, space, image.size());
}

void Canvas::set_image(const QImage& image, const QColorSpace& space, const QSize& picture) {
  set_layer(image.isNull() ? nullptr : std::make_unique<ImageLayer>(image, picture, space));
}

void Canvas::set_picture(const ShownXyz& shown) {
  set_layer(shown.xyz ? std::make_unique<XyzLayer>(shown) : nullptr);
}

void Canvas::set_part(const QPoint& corner, const QImage& part) {
  auto* layer = qobject_cast<ImageLayer*>(layer_.get());
  if (layer == nullptr) return;
  layer->set_part(corner, part);
  const double times = scale() * layer->size().width() / layer->image().width();
  const QRectF shown(target().topLeft() + QPointF(corner) * times, QSizeF(part.size()) * times);
  update(shown.toAlignedRect().adjusted(-1, -1, 1, 1));
}

void Canvas::set_viewing(const Viewing& viewing) {
  viewing_ = viewing;
  for (PictureLayer* layer : {layer_.get(), right_.get()})
    if (layer != nullptr) layer->set_viewing(viewing);
  update();
  Q_EMIT xyz_wanted();
}

bool Canvas::shows_numbers() const {
  return numbers_ && layer_ && scale() * devicePixelRatioF() >= numbers_from;
}

bool Canvas::wants_xyz() const { return viewing_.stops != 0 || viewing_.gamut || shows_numbers(); }

void Canvas::set_overlay(const QStringList& lines) {
  overlay_ = lines;
  setAccessibleDescription(sentence_of(picture_size(), overlay_, stale_));
  update();
}

void Canvas::set_axes(const std::optional<std::array<QPointF, 3>>& axes) {
  axes_ = axes;
  update();
}

void Canvas::set_stale(const QString& reason) {
  stale_ = reason;
  setAccessibleDescription(sentence_of(picture_size(), overlay_, stale_));
  update();
}

void Canvas::set_numbers(bool shown) {
  numbers_ = shown;
  update();
  Q_EMIT xyz_wanted();
}

void Canvas::set_marks(const QList<CanvasMark>& marks) {
  marks_ = marks;
  update();
}

void Canvas::fit() {
  fitted_ = true;
  update();
  Q_EMIT view_changed();
}

void Canvas::one_to_one() {
  fitted_ = false;
  zoom_ = 1;
  centre_ = middle();
  update();
  Q_EMIT view_changed();
}

void Canvas::set_view(const View& view) {
  fitted_ = view.fitted;
  zoom_ = view.zoom;
  centre_ = view.centre;
  update();
}

void Canvas::show_pixel(const QPoint& pixel) {
  zoom_ = std::max(scale() * devicePixelRatioF(), 8.0);
  fitted_ = false;
  centre_ = QPointF(pixel) + QPointF(0.5, 0.5);
  update();
  Q_EMIT view_changed();
}

void Canvas::set_wipe(const ShownXyz& right) {
  right_ = right.xyz ? followed(std::make_unique<XyzLayer>(right)) : nullptr;
  if (right_ == nullptr) unsetCursor();
  update();
}

void Canvas::set_divider(double share) {
  divider_ = std::clamp(share, 0.0, 1.0);
  update();
}

bool Canvas::is_at_divider(const QPointF& place) const {
  return right_ != nullptr && std::abs(place.x() - divider_ * width()) <= 6;
}

QPointF Canvas::middle() const {
  return QPointF(picture_size().width() / 2.0, picture_size().height() / 2.0);
}

QSize Canvas::device_size() const { return size() * devicePixelRatioF(); }

double Canvas::scale() const {
  if (layer_ == nullptr) return 1;
  if (!fitted_) return zoom_ / devicePixelRatioF();
  const QSize size = picture_size();
  return std::min(static_cast<double>(width()) / size.width(),
                  static_cast<double>(height()) / size.height());
}

QRectF Canvas::target() const {
  const double factor = scale();
  const QSizeF shown = QSizeF(picture_size()) * factor;
  const QPointF middle(width() / 2.0, height() / 2.0);
  const QPointF centre = fitted_ ? this->middle() : centre_;
  QPointF corner = middle - centre * factor;
  // At 1:1 pixels fall on pixels.
  const double ratio = devicePixelRatioF();
  corner = QPointF(std::round(corner.x() * ratio) / ratio, std::round(corner.y() * ratio) / ratio);
  return {corner, shown};
}

std::optional<QPoint> Canvas::pixel_at(const QPointF& place) const {
  if (layer_ == nullptr) return std::nullopt;
  const QPointF inside = (place - target().topLeft()) / scale();
  const QPoint pixel(static_cast<int>(std::floor(inside.x())),
                     static_cast<int>(std::floor(inside.y())));
  if (!QRect(QPoint(), picture_size()).contains(pixel)) return std::nullopt;
  return pixel;
}

QPointF Canvas::place_of(const QPoint& pixel) const {
  return target().topLeft() + QPointF(pixel) * scale();
}

void Canvas::paintEvent(QPaintEvent* event) {
  QPainter painter(this);
  painter.fillRect(rect(), surround);
  if (layer_ != nullptr) {
    layer_->paint(painter, target(), event->rect(), devicePixelRatioF());
    if (right_ != nullptr) paint_wipe(painter);
    if (shows_numbers()) paint_numbers(painter);
    paint_outside(painter);
  }
  if (!stale_.isEmpty()) painter.fillRect(rect(), QColor(119, 119, 119, 128));
  paint_marks(painter);
  paint_overlay(painter);
  paint_axes(painter);
  painter.end();
  Q_EMIT painted();
}

void Canvas::paint_wipe(QPainter& painter) {
  const double x = divider_ * width();
  const QRectF side(x, 0, width() - x, height());
  painter.setClipRect(side);
  right_->paint(painter, target(), side, devicePixelRatioF());
  painter.setClipping(false);
  for (const auto& [color, thick] : {std::pair(Qt::black, 3.0), std::pair(Qt::white, 1.0)}) {
    painter.setPen(QPen(color, thick));
    painter.drawLine(QPointF(x, 0), QPointF(x, height()));
  }
}

void Canvas::zoom_about(const QPointF& place, double factor) {
  const QPointF inside = (place - target().topLeft()) / scale();
  const double now = scale() * devicePixelRatioF();
  zoom_ = std::clamp(now * factor, 1.0 / 16, 64.0);
  fitted_ = false;
  const QPointF middle(width() / 2.0, height() / 2.0);
  centre_ = inside - (place - middle) / scale();
  update();
  Q_EMIT view_changed();
}

void Canvas::zoom(double steps, const QPointF& place) {
  zoom_about(place, std::pow(2.0, steps / 2));
}

void Canvas::shift(const QPointF& by) {
  if (fitted_) zoom_about(rect().center(), 1);
  centre_ -= by / scale();
  update();
  Q_EMIT view_changed();
}

void Canvas::mousePressEvent(QMouseEvent* event) {
  last_ = pressed_ = event->position();
  moved_ = false;
  wiping_ = event->button() == Qt::LeftButton && is_at_divider(pressed_);
}

void Canvas::mouseMoveEvent(QMouseEvent* event) {
  if (wiping_ && event->buttons().testFlag(Qt::LeftButton)) {
    moved_ = true;
    return set_divider(event->position().x() / std::max(1, width()));
  }
  if (event->buttons() == Qt::NoButton) {
    if (right_ != nullptr)
      setCursor(is_at_divider(event->position()) ? Qt::SplitHCursor : Qt::ArrowCursor);
    Q_EMIT hovered(pixel_at(event->position()));
    return;
  }
  // A hand that trembles has not moved.
  if (!moved_ && (event->position() - pressed_).manhattanLength() < 4) return;
  moved_ = true;
  const QPointF by = event->position() - last_;
  last_ = event->position();
  for (const Qt::MouseButton button : {Qt::LeftButton, Qt::MiddleButton, Qt::RightButton})
    if (event->buttons().testFlag(button)) {
      Q_EMIT dragged(by, button, event->modifiers());
      return;
    }
}

void Canvas::mouseReleaseEvent(QMouseEvent* event) {
  if (moved_ || event->button() != Qt::LeftButton) return;
  if (const auto pixel = pixel_at(event->position())) Q_EMIT clicked(*pixel, event->modifiers());
}

void Canvas::wheelEvent(QWheelEvent* event) {
  const double steps = event->angleDelta().y() / 120.0;
  if (event->modifiers().testFlag(Qt::ControlModifier))
    zoom(steps, event->position());
  else
    Q_EMIT wheeled(steps, event->position(), event->modifiers());
  event->accept();
}

void Canvas::leaveEvent(QEvent*) { Q_EMIT hovered(std::nullopt); }

void Canvas::resizeEvent(QResizeEvent*) { Q_EMIT resized(); }

/// Tiles are kept of what is seen.
void Canvas::hideEvent(QHideEvent*) {
  for (PictureLayer* layer : {layer_.get(), right_.get()})
    if (layer != nullptr) layer->forget();
}

}  // namespace metamer::gui
