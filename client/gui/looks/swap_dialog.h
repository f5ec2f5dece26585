#pragma once

#include <QComboBox>
#include <QDialog>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <memory>

#include "client/gui/document/document.h"
#include "client/gui/plot/spectrum_plot.h"
#include "common/spectral/spectrum.h"

namespace metamer::gui {

/// What is swapped: light of a light, or paint of a material.
enum class Swapped { light, paint };

/// Chooses another spectrum for a light or a paint of a scene, by name, file or from a list. What
/// is chosen is seen in the pictures at once; taken it is one command to undo, left it is gone.
class SwapDialog : public QDialog {
  Q_OBJECT
 public:
  SwapDialog(Document& document, Swapped what, QWidget* parent = nullptr);

  /// A light, "*" for all of them, or a material.
  void set_target(const QString& name);
  /// As on the command line: "F11", "2856K", "paints.sp#red". It is read on the thread pool.
  void set_word(const QString& word);
  /// Whether what is chosen is there, and seen.
  bool is_chosen() const { return chosen_.has_value(); }

  void done(int result) override;

 Q_SIGNALS:
  void settled();  ///< What was chosen is there, or why it is not.

 private:
  struct Found;
  void fill_targets();
  void fill_list();
  void choose_row(QListWidgetItem* row);
  void browse();
  void start_reading();
  void take(const Result<Found>& found);
  void preview();
  client::Look changed() const;
  QString command_text() const;

  Document& document_;
  Swapped what_;
  client::Look before_;
  QComboBox* target_;
  QComboBox* property_;  ///< Of a paint.
  QLineEdit* word_;
  QListWidget* list_;
  SpectrumPlot* plot_;
  QLabel* fault_;
  QPushButton* use_;
  QString copied_;      ///< The material whose paint is chosen; empty: none.
  unsigned asked_ = 0;  ///< Counts what was to be read: the newest wins.
  std::optional<v1::Spectrum> chosen_;
};

}  // namespace metamer::gui
