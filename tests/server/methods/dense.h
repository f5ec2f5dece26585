#pragma once

#include "common/spectral/wavelengths.h"

namespace metamer::test {

/// The middles of 9400 cells of 0.05 nm from 360 to 830: the plain sum that integrals over cells
/// are held against. It is within 1e-6 where every sample of a spectrum is a multiple of 0.05 nm.
inline Wavelengths dense() {
  std::vector<double> nm(9400);
  for (std::size_t i = 0; i < nm.size(); ++i) nm[i] = 360 + 0.05 * (static_cast<double>(i) + 0.5);
  return Wavelengths::weighted(nm, std::vector<double>(nm.size(), 0.05));
}

}  // namespace metamer::test
