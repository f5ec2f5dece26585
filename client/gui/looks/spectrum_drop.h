#pragma once

#include <QMimeData>
#include <QObject>

#include "client/gui/app/main_window.h"

namespace metamer::gui {

/// A spectrum that is dropped onto the live picture, by a word of the command line or a file: a
/// paint becomes that of the material under it, of a light a dialog asks which one it is. Where
/// nothing is known of the place, the dialog asks for the material, too.
class SpectrumDrop : public QObject {
  Q_OBJECT
 public:
  explicit SpectrumDrop(MainWindow& window);

  bool eventFilter(QObject* watched, QEvent* event) override;
  /// The word; empty: it is none, a picture or a scene, say.
  static QString word_of(const QMimeData& data);
  /// Onto a pixel of the live page in front.
  void drop(const QString& word, const std::optional<QPoint>& pixel);

 private:
  void watch();
  void paint(const QString& word, const v1::Spectrum& paint, const QPoint& pixel);
  void ask(const QString& word, bool light);

  MainWindow& window_;
};

}  // namespace metamer::gui
