#include "client/gui/models/parameter_box.h"

#include <QHBoxLayout>
#include <QLabel>

#include "client/gui/app/number_box.h"
#include "common/problem.h"

namespace metamer::gui {

ParameterBox::ParameterBox(const models::Parameter& parameter, QWidget* parent)
    : QWidget(parent),
      parameter_(parameter),
      set_(new QCheckBox),
      spin_(new NumberBox(parameter.min, parameter.max, parameter.default_value)) {
  const QString name = QString::fromUtf8(parameter.name), unit = QString::fromUtf8(parameter.unit);
  set_->setAccessibleName(tr("Set %1").arg(name));
  set_->setToolTip(tr("Left to the diagram where it is not set"));
  spin_->setAccessibleName(name);
  spin_->setToolTip(QString::fromUtf8(parameter.meaning));
  auto* range = new QLabel(QStringLiteral("%1 – %2 %3  %4")
                               .arg(QString::fromStdString(number_text(parameter.min)),
                                    QString::fromStdString(number_text(parameter.max)), unit,
                                    QString::fromUtf8(parameter.meaning)));
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->addWidget(set_);
  row->addWidget(spin_);
  row->addWidget(range, 1);
  connect(spin_, &QDoubleSpinBox::valueChanged, this, [this] {
    set_->setChecked(true);
    Q_EMIT changed();
  });
  connect(set_, &QCheckBox::toggled, this, &ParameterBox::changed);
}

std::optional<double> ParameterBox::value() const {
  return set_->isChecked() ? std::optional(spin_->value()) : std::nullopt;
}

}  // namespace metamer::gui
