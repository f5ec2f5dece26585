#pragma once

#include <QFormLayout>
#include <QLabel>
#include <QPushButton>
#include <QTreeWidget>
#include <QWidget>
#include <vector>

#include "client/gui/models/parameter_box.h"
#include "client/gui/plot/figure_plot.h"
#include "client/tools/figures/curves.h"

namespace metamer::gui {

/// All illumination models and their parts: equation, paper, parameters with their ranges, and a
/// diagram, for which parameters can be set; and the source's diagrams.
class ModelsPage : public QWidget {
  Q_OBJECT
 public:
  explicit ModelsPage(QWidget* parent = nullptr);

  QTreeWidget& tree() { return *tree_; }
  FigurePlot& plot() { return *plot_; }
  const std::vector<ParameterBox*>& parameters() const { return parameters_; }
  /// What is said of the one that is chosen.
  QString text() const { return text_->text(); }

 Q_SIGNALS:
  /// The diagram is that of what is chosen.
  void shown();

 private:
  QWidget* make_right();
  void fill_tree();
  void choose();
  void describe(const client::CatalogueItem& item);
  void ask();

  std::vector<client::CatalogueItem> items_;
  std::vector<client::Figure> source_;
  QTreeWidget* tree_;
  QLabel* text_;
  QFormLayout* form_;
  QWidget* set_;
  QPushButton* reset_;
  std::vector<ParameterBox*> parameters_;
  FigurePlot* plot_;
  quint64 asked_ = 0;
};

}  // namespace metamer::gui
