#pragma once

#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QWidget>
#include <optional>

#include "common/models/registry.h"

namespace metamer::gui {

/// A parameter of a diagram: set to a value in its range, or left to the diagram, which may draw a
/// curve for each of several values.
class ParameterBox : public QWidget {
  Q_OBJECT
 public:
  explicit ParameterBox(const models::Parameter& parameter, QWidget* parent = nullptr);

  const models::Parameter& parameter() const { return parameter_; }
  std::optional<double> value() const;
  void set_value(double value) { spin_->setValue(value); }
  void leave() { set_->setChecked(false); }

 Q_SIGNALS:
  void changed();

 private:
  models::Parameter parameter_;
  QCheckBox* set_;
  QDoubleSpinBox* spin_;
};

}  // namespace metamer::gui
