#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/spectral/spectrum.h"

/// What light meets at a smooth surface: n(λ) and k(λ), dimensionless, as measured and published.
namespace metamer {

struct Metal {
  const char* name;      ///< "Au".
  const char* citation;  ///< Where the values were published.
  Spectrum n, k;         ///< At the same wavelengths.
};

/// Gold, silver, copper (292 to 892 nm) and aluminium (300 to 800 nm), sorted by name.
const std::vector<Metal>& metals();

/// One term of a Sellmeier formula, n² − 1 = Σ b λ²/(λ² − c), λ in µm.
struct SellmeierTerm {
  double b, c;  ///< c in µm².
};

struct Medium {
  const char* name;  ///< "N-BK7".
  const char* citation;
  std::vector<SellmeierTerm> terms;
  double from, to;  ///< nm: where the formula was fitted.
};

/// N-BK7, N-SF11, diamond, water, sorted by name.
const std::vector<Medium>& media();

/// n² at a wavelength in nm; negative or infinite where the formula has no meaning.
double sellmeier_squared(std::span<const SellmeierTerm> terms, double nm);

/// n = a + b/λ² + c/λ⁴, λ in µm; `nm` in nm.
double cauchy(double a, double b, double c, double nm);

}  // namespace metamer
