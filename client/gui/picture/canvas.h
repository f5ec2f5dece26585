#pragma once

#include <QImage>
#include <QPoint>
#include <QStringList>
#include <QWidget>
#include <memory>
#include <optional>

#include "client/gui/picture/image_layer.h"
#include "client/gui/picture/xyz_layer.h"

namespace metamer::gui {

/// A place of a picture that is marked: shares of its width and height, 0..1.
struct CanvasMark {
  QPointF place;
  QString text;
};

/// A picture, on neutral grey: fitted, 1:1 (a pixel of the picture on a pixel of the device) or
/// zoomed by the wheel; with text over its corner, and an axis icon. Knows nothing of where
/// pictures come from.
class Canvas : public QWidget {
  Q_OBJECT
 public:
  explicit Canvas(QWidget* parent = nullptr);

  /// RGB32; a null image: none is shown.
  void set_image(const QImage& image, const QColorSpace& space = QColorSpace::SRgb);
  /// The same where the image stands for a larger picture.
  void set_image(const QImage& image, const QColorSpace& space, const QSize& picture);
  /// A part of the image anew, if it lies inside it.
  void set_part(const QPoint& corner, const QImage& part);
  void set_picture(const ShownXyz& shown);
  /// The numbers of the picture itself, however it is looked at; null: none is shown. Of X Y Z it
  /// is made anew, as a whole.
  QImage image() const { return layer_ ? layer_->image() : QImage(); }
  /// Of the picture, in its pixels.
  QSize picture_size() const { return layer_ ? layer_->size() : QSize(0, 0); }
  /// What is painted; null: nothing.
  const PictureLayer* layer() const { return layer_.get(); }

  const Viewing& viewing() const { return viewing_; }
  void set_viewing(const Viewing& viewing);
  /// Whether there is more to see of X Y Z than of 8 bits: exposure, gamut, or numbers.
  bool wants_xyz() const;
  /// Lines over the upper left corner; none: nothing is shown.
  void set_overlay(const QStringList& lines);
  /// The directions on the screen of x, y and z of the scene, each at most 1 long; none: no icon.
  void set_axes(const std::optional<std::array<QPointF, 3>>& axes);
  /// The picture is of before: shown paler, with the reason.
  void set_stale(const QString& reason);
  const QString& stale() const { return stale_; }
  void set_numbers(bool shown);
  void set_marks(const QList<CanvasMark>& marks);

  void fit();
  void one_to_one();
  /// A picture that stands still: the wheel's steps zoom it about a place, a drag shifts it.
  void zoom(double steps, const QPointF& place);
  void shift(const QPointF& by);
  bool fitted() const { return fitted_; }
  /// What is seen of a picture, as another canvas can show it of one that is as large.
  struct View {
    bool fitted = true;
    double zoom = 1;  ///< Device pixels a pixel of the picture, where it is not fitted.
    QPointF centre;   ///< In the middle of the widget, in the picture's pixels.
  };
  View view() const { return {fitted_, zoom_, centre_}; }
  void set_view(const View& view);
  /// Brings a pixel into the middle, large enough to be seen.
  void show_pixel(const QPoint& pixel);

  /// Another picture of that size right of a divider, which can be dragged; none of null ones.
  void set_wipe(const ShownXyz& right);
  /// Where the divider is, as a share of the widget's width, 0..1.
  double divider() const { return divider_; }
  void set_divider(double share);

  /// Pixels of the device that a picture as large as this widget would have.
  QSize device_size() const;
  /// The pixel under a place of this widget; nothing: beside the picture.
  std::optional<QPoint> pixel_at(const QPointF& place) const;
  /// Where a pixel's upper left corner lies here.
  QPointF place_of(const QPoint& pixel) const;

  QSize sizeHint() const override { return {640, 480}; }
  static constexpr double numbers_from =
      32;  ///< Device pixels a picture's pixel, for numbers in it.

 Q_SIGNALS:
  void painted();
  void hovered(const std::optional<QPoint>& pixel);
  void clicked(const QPoint& pixel, Qt::KeyboardModifiers modifiers);
  /// A drag with this button from here on, in logical pixels since the last one; the camera's, say.
  void dragged(const QPointF& by, Qt::MouseButton button, Qt::KeyboardModifiers modifiers);
  void wheeled(double steps, const QPointF& place, Qt::KeyboardModifiers modifiers);
  void resized();
  /// By fit() to shift() and show_pixel(), not by set_view().
  void view_changed();
  /// It may be of X Y Z that there is more to see now, or no more: wants_xyz().
  void xyz_wanted();

 protected:
  void paintEvent(QPaintEvent*) override;
  void mousePressEvent(QMouseEvent*) override;
  void mouseMoveEvent(QMouseEvent*) override;
  void mouseReleaseEvent(QMouseEvent*) override;
  void wheelEvent(QWheelEvent*) override;
  void leaveEvent(QEvent*) override;
  void resizeEvent(QResizeEvent*) override;
  void hideEvent(QHideEvent*) override;

 private:
  QRectF target() const;
  QPointF middle() const;  ///< Of the picture, in its pixels.
  double scale() const;    ///< Logical pixels a pixel of the picture.
  void zoom_about(const QPointF& place, double factor);
  void set_layer(std::unique_ptr<PictureLayer> layer);
  std::unique_ptr<PictureLayer> followed(std::unique_ptr<PictureLayer> layer);
  bool shows_numbers() const;
  void paint_wipe(QPainter& painter);
  bool is_at_divider(const QPointF& place) const;
  void paint_overlay(QPainter& painter) const;
  void paint_axes(QPainter& painter) const;
  void paint_numbers(QPainter& painter) const;
  void paint_outside(QPainter& painter) const;
  void paint_marks(QPainter& painter) const;

  std::unique_ptr<PictureLayer> layer_, right_;
  Viewing viewing_;
  QStringList overlay_;
  QList<CanvasMark> marks_;
  std::optional<std::array<QPointF, 3>> axes_;
  QString stale_;
  bool numbers_ = false, fitted_ = true, moved_ = false, wiping_ = false;
  double divider_ = 0.5;
  double zoom_ = 1;  ///< Device pixels a pixel of the picture, where it is not fitted.
  QPointF centre_;   ///< The picture's place in the middle of the widget, in its pixels.
  QPointF last_, pressed_;
};

}  // namespace metamer::gui
