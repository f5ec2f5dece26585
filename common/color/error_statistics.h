#pragma once

#include <cstddef>
#include <span>

namespace metamer {

/// What many errors come to. Those that are not finite have no part in the numbers: they are
/// counted, and whoever prints the numbers says so.
struct ErrorStatistics {
  double mean = 0;
  double median = 0;
  double percentile_95 = 0;
  double percentile_99 = 0;
  double maximum = 0;
  std::size_t at = 0;                ///< Where the maximum stands first.
  std::size_t count = 0;             ///< Finite ones.
  std::size_t not_finite = 0;        ///< NaN or infinite.
  std::size_t first_not_finite = 0;  ///< Where.
};

/// Percentiles lie on the line between the two neighbouring values (R. J. Hyndman and Y. Fan,
/// Sample quantiles in statistical packages, The American Statistician 50, 361 (1996), their
/// definition 7). All zero where there is no finite one.
ErrorStatistics error_statistics(std::span<const double> errors);

}  // namespace metamer
