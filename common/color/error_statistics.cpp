#include "common/color/error_statistics.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace metamer {
namespace {

/// The `share` (0 to 1) of a sorted list.
double quantile(const std::vector<double>& sorted, double share) {
  const double position = share * static_cast<double>(sorted.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const double above = sorted[std::min(below + 1, sorted.size() - 1)];
  return sorted[below] + (position - static_cast<double>(below)) * (above - sorted[below]);
}

}  // namespace

ErrorStatistics error_statistics(std::span<const double> errors) {
  ErrorStatistics result;
  std::vector<double> sorted;
  sorted.reserve(errors.size());
  double sum = 0;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (!std::isfinite(errors[i])) {
      if (result.not_finite++ == 0) result.first_not_finite = i;
      continue;
    }
    if (sorted.empty() || errors[i] > result.maximum) {
      result.maximum = errors[i];
      result.at = i;
    }
    sum += errors[i];
    sorted.push_back(errors[i]);
  }
  result.count = sorted.size();
  if (sorted.empty()) return result;

  std::sort(sorted.begin(), sorted.end());
  result.mean = sum / static_cast<double>(sorted.size());
  result.median = quantile(sorted, 0.5);
  result.percentile_95 = quantile(sorted, 0.95);
  result.percentile_99 = quantile(sorted, 0.99);
  return result;
}

}  // namespace metamer
