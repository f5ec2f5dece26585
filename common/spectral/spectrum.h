#pragma once

#include <cstddef>
#include <vector>

#include "common/problem.h"
#include "common/spectral/wavelengths.h"

namespace metamer {

/// A function of wavelength, linearly interpolated between its samples.
struct Spectrum {
  std::vector<double> nm;      ///< Rising, at least one.
  std::vector<double> values;  ///< As many; finite.

  bool operator==(const Spectrum&) const = default;
};

/// Errors: no samples, unequal counts, a number that is not finite, wavelengths not positive,
/// unsorted or repeated.
Result<Spectrum> make_spectrum(std::vector<double> nm, std::vector<double> values);

/// What a spectrum is where it has no data.
enum class Outside {
  zero,  ///< An emission: no light that nobody measured.
  hold,  ///< A property: its end value.
};

/// A spectrum at the positions of a rendering, and how many of them lay outside its data.
struct Resampled {
  std::vector<double> values;
  std::size_t below = 0;  ///< Positions below its first sample.
  std::size_t above = 0;  ///< Positions above its last.
};

Resampled resample(const Spectrum& spectrum, const std::vector<double>& nm, Outside outside);

}  // namespace metamer
