#include "client/gui/spectra/spectrum_curve.h"

#include <algorithm>

namespace metamer::gui {

Curve curve_of(const Spectrum& spectrum, const QString& name) {
  return {.name = name, .wavelengths = spectrum.nm, .values = spectrum.values};
}

void draw_spectra(SpectrumPlot& plot, const QList<Listed>& rows) {
  const auto is_light = [](const Listed& row) { return row->emission(); };
  const bool lights = std::any_of(rows.begin(), rows.end(), is_light);
  const bool both = lights && !std::all_of(rows.begin(), rows.end(), is_light);
  QList<Curve> curves;
  for (const Listed& row : rows) {
    Curve curve = curve_of(row->spectrum().spectrum(), row->label());
    curve.right = both && row->emission();
    curves << curve;
  }
  const QString power = SpectrumPlot::tr("relative power"), share = SpectrumPlot::tr("reflectance");
  plot.set_curves(curves, both || !lights ? share : power, both ? power : QString());
}

}  // namespace metamer::gui
