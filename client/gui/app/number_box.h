#pragma once

#include <QDoubleSpinBox>

namespace metamer::gui {

/// A number to a millionth, shown with the digits that it has: "400", "0.999997".
class NumberBox : public QDoubleSpinBox {
 public:
  explicit NumberBox(double from, double to, double value, QWidget* parent = nullptr)
      : QDoubleSpinBox(parent) {
    setDecimals(6);
    setRange(from, to);
    setStepType(QAbstractSpinBox::AdaptiveDecimalStepType);
    setValue(value);
    setMinimumWidth(fontMetrics().horizontalAdvance(QStringLiteral("0.000000")) + 36);
  }

 protected:
  QString textFromValue(double value) const override { return locale().toString(value, 'g', 9); }
};

}  // namespace metamer::gui
