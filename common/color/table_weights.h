#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/color/xyz.h"
#include "common/problem.h"

namespace metamer {

/// What a reflectance is between its samples.
enum class TableWeights {
  lines,  ///< Straight lines: under_light.
  astm,   ///< As the weights of ASTM E308-15, table 5, take it: for samples by 10 or 20 nm.
};

std::optional<TableWeights> find_table_weights(std::string_view word);  ///< "lines", "astm".
const std::vector<std::string>& table_weights_words();  ///< In the order of the enumeration.

/// As under_light, with such weights. `astm`: Lagrange's polynomials through the four samples
/// around, in the first and the last interval through three, beyond the ends the end value (ASTM
/// E2022). Error, for `astm` alone: fewer than 4 samples, or uneven distances.
Result<ObserverWeights> weights_under(TableWeights weights, const Observer& observer,
                                      const Spectrum& emission, const std::vector<double>& nm);

}  // namespace metamer
