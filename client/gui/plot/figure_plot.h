#pragma once

#include <QWidget>
#include <vector>

#include "client/tools/figures/figure.h"
#include "common/problem.h"

class QCPAxisRect;
class QCustomPlot;

namespace metamer::gui {

/// A diagram of an illumination model: its panels side by side, straight or around the normal, each
/// with its legend. A menu saves it.
class FigurePlot : public QWidget {
  Q_OBJECT
 public:
  explicit FigurePlot(QWidget* parent = nullptr);

  void set_figure(const client::Figure& figure);
  const client::Figure& figure() const { return figure_; }

  /// Into a .pdf, a .png (both as on paper) or a .csv. Errors: another extension; it can't be
  /// written.
  Result<void> save(const QString& file);
  void save_as();

 protected:
  void changeEvent(QEvent*) override;
  void contextMenuEvent(QContextMenuEvent*) override;

 private:
  /// A panel around the normal keeps its circles round: so much of a scale is to be seen.
  struct RoundPanel {
    QCPAxisRect* rect;
    double top;
  };

  void draw(const QPalette& palette);
  void draw_panel(const client::Panel& panel, int row, int column, const QPalette& palette);
  void keep_round();

  QCustomPlot* plot_;
  client::Figure figure_;
  std::vector<RoundPanel> round_;
};

}  // namespace metamer::gui
