#pragma once

#include "server/transport/gather.h"

/// The counts of Method::preparation_cost and resolve_cost, ns. They were measured once, with
/// tracer_bench (tests/bench), on a Xeon of 2.1 GHz; only their ratios matter.
namespace metamer::costs {

/// A loop over a row of values in cache, with what goes before and after it.
inline double loop(std::size_t values) { return 4 + 0.06 * static_cast<double>(values); }

/// A value that is looked up by name.
inline constexpr double lookup = 30;

/// Rows of spectra, each at so many wavelengths.
inline double table(std::size_t rows, std::size_t values) {
  return 10 * static_cast<double>(rows) * static_cast<double>(values);
}

/// The bands of chains of so many curves, and lights of so many spectra in them (ChainBands). By
/// callgrind: 13 million instructions a curve, three million a spectrum, of which 4 take 1 ns.
inline double band_choice(std::size_t curves, std::size_t emissions) {
  return 3.2e6 * static_cast<double>(curves) + 0.7e6 * static_cast<double>(emissions);
}

inline double terms(const Gather& gather) {
  std::size_t count = gather.terms().size();
  for (std::size_t s = 0; s < gather.surfaces().size(); ++s) count += gather.weights(s).size();
  return static_cast<double>(count);
}

/// But the one that comes straight from the surfaces.
inline double chains(const Gather& gather) {
  return static_cast<double>(gather.chains().size() - 1);
}

}  // namespace metamer::costs
