#include "client/gui/plot/axis_scale.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>

namespace metamer::gui {
namespace {

constexpr double room = 0.12;      // at each end, of what the values take
constexpr double least_log = 0.3;  // decades: a few values that are all the same take as much

QMap<double, QString> ticks_at(const AxisScale& scale, std::initializer_list<double> steps) {
  QMap<double, QString> ticks;
  for (double power = std::pow(10, std::floor(std::log10(scale.from))); power <= scale.to;
       power *= 10)
    for (const double step : steps)
      if (const double tick = step * power; tick >= scale.from && tick <= scale.to)
        ticks.insert(tick, QString::number(tick, 'g', 3));
  return ticks;
}

}  // namespace

AxisScale axis_scale(const QList<double>& values, double floor) {
  if (values.isEmpty()) return {};
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double least = std::max(*low, floor), most = std::max(*high, floor);
  if (most < 2 * least) {
    const double span = std::max(most - least, 0.02 * most);
    return {.logarithmic = false, .from = least - 2 * room * span, .to = most + 2 * room * span};
  }
  const double factor = std::pow(10, room * std::max(std::log10(most / least), least_log));
  return {.logarithmic = true, .from = least / factor, .to = most * factor};
}

QMap<double, QString> log_ticks(const AxisScale& scale) {
  if (scale.to > 500 * scale.from) return ticks_at(scale, {1});
  if (scale.to > 8 * scale.from) return ticks_at(scale, {1, 2, 5});
  return ticks_at(scale, {1, 1.5, 2, 3, 4, 5, 7});
}

}  // namespace metamer::gui
