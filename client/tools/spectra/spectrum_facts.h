#pragma once

#include <cstddef>
#include <optional>
#include <variant>
#include <vector>

#include "client/tools/spectra/spectra_files.h"
#include "common/color/chromaticity.h"
#include "common/color/lab.h"
#include "common/color/rendering_index.h"
#include "common/color/table_weights.h"

/// What a spectrum is: its range, and how it looks.
namespace metamer::client {

/// A light as an observer sees it.
struct ObservedLight {
  Observer observer;
  double luminance;                          ///< Y of E[3.2-2], the integral from 360 to 830 nm.
  std::optional<Chromaticity> chromaticity;  ///< Nothing: it is dark.
};

struct EmissionFacts {
  std::vector<ObservedLight> observed;  ///< By the observers of 1931 and 1964, and by one's own.
  // These are defined for the observer of 1931.
  std::optional<ColorTemperature> temperature;  ///< Nothing: no black body is like it.
  std::optional<RenderingIndex> rendering;      ///< Nothing where the CIE defines none.
};

struct ReflectanceFacts {
  double luminance;                          ///< Of a perfect white's, under the light.
  std::optional<Chromaticity> chromaticity;  ///< Nothing: it is black.
  std::optional<Lab> lab;  ///< The light's white is white; nothing: that has a component of 0.
};

struct SpectrumFacts {
  double from, to;      ///< nm, of the first and the last sample.
  std::size_t samples;  ///< At least 1.
  double min, max;      ///< Of the samples.
  std::variant<EmissionFacts, ReflectanceFacts> look;
};

/// `light`, `observer` and `weights` are what a reflectance is seen by; an emission is seen by the
/// CIE's observers, and by `observer` where it is another.
/// Errors: those of weights_under.
Result<SpectrumFacts> spectrum_facts(const LoadedSpectrum& one, const Spectrum& light,
                                     const Observer& observer,
                                     TableWeights weights = TableWeights::lines);

}  // namespace metamer::client
