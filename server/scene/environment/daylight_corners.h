#pragma once

#include <array>
#include <vector>

#include "common/color/chromaticity.h"
#include "common/color/matrix3.h"
#include "common/spectral/spectrum.h"

namespace metamer {

/// Three spectra of daylight's components (daylight_of) whose chromaticities have others between
/// them: so that all of these are sums of what is not below 0. Of the triangles of some directions'
/// tangents around the others, that whose spectra have the most light where they have the least.
class DaylightCorners {
 public:
  explicit DaylightCorners(const std::vector<Chromaticity>& within);

  /// Cut off at 0.
  const std::vector<Spectrum>& spectra() const { return spectra_; }
  /// How much of each has this chromaticity, one of those within, and luminance.
  Vector3 shares(const Chromaticity& of, double luminance) const;

 private:
  std::array<Chromaticity, 3> corners_;
  std::vector<Spectrum> spectra_;
  Vector3 luminances_;  ///< Of the spectra, for the 1931 observer.
};

}  // namespace metamer
