#pragma once

#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QTableWidget>

#include "client/gui/picture/picture_page.h"
#include "client/gui/sheet/sheet_work.h"

class QDoubleSpinBox;

namespace metamer::gui {

/// A metamerism sheet: lights across, paints down, with maps of their differences and what three
/// numbers make of the first paint; beside it the table of the paints by themselves, and which is
/// nearer in a sentence.
class SheetPage : public PicturePage {
  Q_OBJECT
 public:
  explicit SheetPage(QWidget* parent = nullptr);

  bool save_own() override;
  Canvas& canvas() override { return *canvas_; }

  /// The paints that can be chosen, and the lights to begin with.
  void set_choices(const QStringList& paints, const QStringList& lights);
  /// As a metameric pair of the scene is, once it is known; ignored when a paint was chosen.
  void suggest(const QString& a, const QString& b);
  SheetWish wish() const;
  void set_wish(const SheetWish& wish);

  void show_busy(const QString& what);
  void show_fault(const QString& why);
  void show_sheet(const std::shared_ptr<const MadeSheet>& sheet);
  const std::shared_ptr<const MadeSheet>& sheet() const { return sheet_; }
  const QTableWidget& table() const { return *table_; }
  QString verdict() const { return verdict_->text(); }

  /// By the file's ending: .png or .pdf. It is written in the thread pool.
  void save(const QString& file);

 Q_SIGNALS:
  void asked();  ///< wish() is to be made.
  void saved(const QString& file, const QString& fault);

 private:
  QWidget* make_choices();
  QWidget* make_answers();
  void add_light(const QString& word);
  void show_table();
  void save_as(const QString& ending);

  Canvas* canvas_;
  QListWidget* lights_;
  QLineEdit* light_;
  std::array<QComboBox*, 3> paints_{};
  QComboBox* painted_;
  QDoubleSpinBox* limit_;
  QPushButton* make_;
  QLabel *verdict_, *state_;
  QTableWidget* table_;
  QPushButton *png_, *pdf_;
  bool chosen_ = false;
  std::shared_ptr<const MadeSheet> sheet_;
};

}  // namespace metamer::gui
