#pragma once

#include <QWidget>
#include <cstddef>
#include <optional>
#include <vector>

class QCustomPlot;

namespace metamer::gui {

/// How many pixels differ by how much, with the limit as a line.
class HistogramPlot : public QWidget {
  Q_OBJECT
 public:
  explicit HistogramPlot(QWidget* parent = nullptr);
  /// Counts in equal bins from 0 to `top`; `unit` names the difference: "ΔE00".
  void set_histogram(const std::vector<std::size_t>& counts, double top, const QString& unit,
                     const std::optional<double>& limit);

 protected:
  void changeEvent(QEvent*) override;

 private:
  void draw();

  QCustomPlot* plot_;
  std::vector<std::size_t> counts_;
  double top_ = 1;
  QString unit_;
  std::optional<double> limit_;
};

}  // namespace metamer::gui
