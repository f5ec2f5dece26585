#pragma once

#include <QComboBox>
#include <QLabel>
#include <QToolButton>
#include <QWidget>
#include <functional>
#include <optional>
#include <vector>

#include "client/gui/compare/compared.h"
#include "client/tools/pictures/picture_layers.h"

namespace metamer::gui {

/// A picture that is at hand: one of another tab. It may take a while to come.
struct PictureAtHand {
  QString title;
  std::function<void(std::function<void(const Picture&)>)> ask;
};
using PicturesAtHand = std::function<QList<PictureAtHand>()>;

/// One of the two pictures to be compared: a file by dialog or drop, or one that is at hand.
class SlotBox : public QWidget {
  Q_OBJECT
 public:
  SlotBox(const QString& name, PicturesAtHand at_hand, QWidget* parent = nullptr);

  const std::optional<PictureSource>& source() const { return source_; }
  void set_source(const PictureSource& source);
  void set_at_hand(const PictureAtHand& one);
  /// What the file was taken for.
  void tell(const QString& what);

 Q_SIGNALS:
  void chosen();

 protected:
  void dragEnterEvent(QDragEnterEvent*) override;
  void dropEvent(QDropEvent*) override;

 private:
  void fill_menu();
  void choose_file();
  void list_layers();
  void choose_layer(int i);

  QString name_;
  PicturesAtHand at_hand_;
  std::optional<PictureSource> source_;
  QToolButton* button_;
  QLabel* title_;
  QComboBox* layers_;
  std::vector<client::PictureLayer> choices_;
  quint64 asked_ = 0;  ///< Sources: one that is still to come counts unless another was chosen.
};

/// The first picture file that is dragged; empty: none is.
QString dragged_picture(const QMimeData& data);

}  // namespace metamer::gui
