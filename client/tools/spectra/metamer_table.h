#pragma once

#include <string>
#include <vector>

#include "common/color/metamerism.h"

/// A reflectance that looks the same under one light and another under another, and by how much.
namespace metamer::client {

struct MetamerTable {
  Spectrum reflectance;  ///< As make_metamer gives it.
  /// From the original, under the CIE's illuminants and the two lights.
  std::vector<Mismatch> differences;
};

/// Errors: those of make_metamer. A light that bears the name of a CIE illuminant is in the table
/// once, as the CIE's.
Result<MetamerTable> metamer_table(const Spectrum& original, const NamedSpectrum& under,
                                   const NamedSpectrum& against, const Observer& observer);

/// The light by which a metamer is told from its original where none is named: A, or D65 where
/// they match under A (CIE 15:2004, 9.2.2: metamers of daylight are to be tried under A).
std::string usual_other_light(const std::string& under);

}  // namespace metamer::client
