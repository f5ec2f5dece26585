#pragma once

#include "client/gui/plot/spectrum_plot.h"
#include "client/gui/spectra/listed_spectrum.h"

namespace metamer::gui {

/// A spectrum as it is drawn.
Curve curve_of(const Spectrum& spectrum, const QString& name);

/// Reflectances by the left axis, lights by the right one where there are both.
void draw_spectra(SpectrumPlot& plot, const QList<Listed>& rows);

}  // namespace metamer::gui
