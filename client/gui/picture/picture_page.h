#pragma once

#include <QPointer>
#include <QWidget>
#include <functional>
#include <optional>

#include "client/gui/picture/canvas.h"
#include "client/gui/picture/picture.h"

namespace metamer::gui {

/// A picture tab of the window. What it cannot do of the picture's actions it leaves alone.
class PicturePage : public QWidget {
  Q_OBJECT
 public:
  using QWidget::QWidget;
  virtual Canvas& canvas() = 0;
  /// What it shows, as far as that is complete and will not change.
  virtual std::optional<Picture> picture() const { return std::nullopt; }
  /// What the picture is called that hand_over() gives; empty: it gives none.
  virtual QString picture_title() const { return picture() ? picture()->name() : QString(); }
  /// Gives the picture, at once or when it has come; never, where the page is gone before.
  virtual void hand_over(std::function<void(const Picture&)> to) {
    if (const auto one = picture()) to(*one);
  }
  /// The document that it is a picture of, as long as that is open; null: of none.
  QObject* subject() const { return subject_; }
  void set_subject(QObject* document) { subject_ = document; }
  /// The action file.save_picture, where a page has files of its own kind. False: it has none.
  virtual bool save_own() { return false; }
  /// The actions render.pause and render.cancel.
  virtual void pause() {}
  virtual void cancel() {}

 private:
  QPointer<QObject> subject_;
};

}  // namespace metamer::gui
