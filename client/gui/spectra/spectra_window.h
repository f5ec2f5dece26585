#pragma once

#include <QLabel>
#include <QLineEdit>
#include <QPointer>
#include <QPushButton>
#include <QTableView>

#include "client/gui/plot/spectrum_plot.h"
#include "client/gui/spectra/choice_boxes.h"
#include "client/gui/spectra/spectra_lists.h"

namespace metamer::gui {

/// The spectra manager: two lists, a plot of what is chosen in them, and what can be done with it.
/// A window of its own, so that rows can be dragged onto pictures.
class SpectraWindow : public QWidget {
  Q_OBJECT
 public:
  explicit SpectraWindow(QWidget* parent = nullptr);

  SpectraLists& lists() { return lists_; }
  SpectrumPlot& plot() { return *plot_; }
  QTableView& view(SpectraTable::Kind kind) {
    return kind == SpectraTable::Kind::lights ? *lights_ : *materials_;
  }
  /// What is chosen, lights first; with nothing chosen all.
  QList<Listed> chosen() const;
  /// Words from a line: a file's name, or several words apart by blanks.
  void add_words(const QString& line);
  void remove_chosen();
  void resample();
  void show_rgb();
  void make_metamer();
  /// Says a sentence below the lists.
  void tell(const QString& text);

 Q_SIGNALS:
  /// The scene's spectra are asked for.
  void scene_wanted();

 protected:
  void dragEnterEvent(QDragEnterEvent*) override;
  void dropEvent(QDropEvent*) override;

 private:
  QWidget* make_top();
  QWidget* make_buttons();
  QTableView* make_view(SpectraTable& table, const QString& title);
  QList<Listed> selected(const QTableView& view, const SpectraTable& table) const;
  void choose(const QList<Listed>& rows);
  void draw();
  void add_files();

  SpectraLists lists_;
  QTableView *lights_, *materials_;
  SpectrumPlot* plot_;
  QLineEdit* word_;
  ObserverBox* observer_;
  SpectrumBox* light_;
  QLabel* told_;
  QPushButton* remove_;
  QList<QPushButton*> of_spectra_;
};

}  // namespace metamer::gui
