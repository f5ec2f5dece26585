#pragma once

#include <QWidget>

namespace metamer::gui {

/// The scale of a map: its colours from 0 to `top`, with numbers.
class RampLegend : public QWidget {
  Q_OBJECT
 public:
  explicit RampLegend(QWidget* parent = nullptr);
  void set_scale(double top, const QString& unit);
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override { return {160, sizeHint().height()}; }

 protected:
  void paintEvent(QPaintEvent*) override;

 private:
  double top_ = 0;
  QString unit_;
};

}  // namespace metamer::gui
