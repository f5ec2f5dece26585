#include "client/tools/figures/figure.h"

#include <algorithm>
#include <cmath>

#include "client/tools/text/csv.h"
#include "common/problem.h"

namespace metamer::client {

std::string csv_text(const Figure& figure) {
  std::string text = "panel,curve,degrees,value\n";
  for (const Panel& panel : figure.panels)
    for (const Curve& curve : panel.curves)
      for (std::size_t i = 0; i < curve.angle.size(); ++i)
        text += csv_field(panel.title) + "," + csv_field(curve.label) + "," +
                number_text(curve.angle[i]) + "," + number_text(curve.value[i]) + "\n";
  return text;
}

Scale scale_of(const Figure& figure, bool polar) {
  double most = 0;
  for (const Panel& panel : figure.panels)
    if (panel.polar == polar)
      for (const Curve& curve : panel.curves)
        most = std::max(most, *std::max_element(curve.value.begin(), curve.value.end()));
  if (!(most > 0)) return {1, 0.25};

  // Steps of 1, 2 or 5 and zeros; three to six of them. A curve may miss the rounding error above.
  const double rough = most / 5;
  const double power = std::pow(10, std::floor(std::log10(rough)));
  double step = 10 * power;
  for (const double nice : {1.0, 2.0, 5.0})
    if (nice * power >= rough * (1 - 1e-9)) {
      step = nice * power;
      break;
    }
  return {step * std::ceil(most / step * (1 - 1e-9)), step};
}

}  // namespace metamer::client
