#pragma once

#include <QList>
#include <QMap>
#include <QString>

/// How far an axis goes, and what stands along it.
namespace metamer::gui {

struct AxisScale {
  bool logarithmic = true;
  double from = 0.1, to = 10;
};

/// All of the values with room around them: logarithmic, but where the largest is less than twice
/// the smallest: linear around them then, without 0. Values below `floor`, above 0, stand at it.
AxisScale axis_scale(const QList<double>& values, double floor);

/// Of a logarithmic axis: 1, 2 and 5 times the powers of ten where there are few, else the powers;
/// at least two.
QMap<double, QString> log_ticks(const AxisScale& scale);

}  // namespace metamer::gui
