#include "common/color/table_weights.h"

#include <algorithm>
#include <cmath>

namespace metamer {
namespace {

/// Lagrange's polynomials of the samples first to end − 1 at x, of which `nm` are the positions.
template <class Take>
void lagrange(const std::vector<double>& nm, std::size_t first, std::size_t end, double x,
              const Take& take) {
  for (std::size_t j = first; j < end; ++j) {
    double product = 1;
    for (std::size_t m = first; m < end; ++m)
      if (m != j) product *= (x - nm[m]) / (nm[j] - nm[m]);
    take(j, product);
  }
}

/// How much each sample has a part in the value at x.
template <class Take>
void interpolate(const std::vector<double>& nm, double x, const Take& take) {
  if (x <= nm.front()) return take(0, 1.0);
  if (x >= nm.back()) return take(nm.size() - 1, 1.0);
  const auto right =
      static_cast<std::size_t>(std::upper_bound(nm.begin(), nm.end(), x) - nm.begin());
  if (right == 1) return lagrange(nm, 0, 3, x, take);
  if (right == nm.size() - 1) return lagrange(nm, nm.size() - 3, nm.size(), x, take);
  lagrange(nm, right - 2, right + 2, x, take);
}

Result<void> check_even(const std::vector<double>& nm) {
  if (nm.size() < 4)
    return problem("ASTM's weights take 4 samples at least, not " + std::to_string(nm.size()));
  const double step = (nm.back() - nm.front()) / static_cast<double>(nm.size() - 1);
  for (std::size_t i = 1; i < nm.size(); ++i)
    if (!(std::abs(nm[i] - nm[i - 1] - step) <= 1e-6 * step))
      return problem("ASTM's weights take samples at even distances, not " +
                     number_text(nm[i - 1]) + " and " + number_text(nm[i]) + " nm among others");
  return {};
}

}  // namespace

const std::vector<std::string>& table_weights_words() {
  static const std::vector<std::string> words = {"lines", "astm"};
  return words;
}

std::optional<TableWeights> find_table_weights(std::string_view word) {
  const auto& words = table_weights_words();
  const auto found = std::find(words.begin(), words.end(), word);
  if (found == words.end()) return std::nullopt;
  return static_cast<TableWeights>(found - words.begin());
}

Result<ObserverWeights> weights_under(TableWeights weights, const Observer& observer,
                                      const Spectrum& emission, const std::vector<double>& nm) {
  if (weights == TableWeights::lines) return under_light(observer, emission, nm);
  if (auto even = check_even(nm); !even) return tl::unexpected(std::move(even.error()));

  // The polynomials are straight lines over 1/8 nm, to 1e-6; what each place weighs goes to the
  // samples around it.
  const std::vector<double> fine =
      Wavelengths::uniform(observer_from_nm, observer_to_nm, 0.125)->nm();
  const ObserverWeights lit = under_light(observer, emission, fine);
  ObserverWeights result;
  for (std::size_t c = 0; c < result.weights.size(); ++c) {
    result.weights[c].resize(nm.size());
    for (std::size_t k = 0; k < fine.size(); ++k)
      interpolate(nm, fine[k], [&](std::size_t i, double share) {
        result.weights[c][i] += share * lit.weights[c][k];
      });
  }
  return result;
}

}  // namespace metamer
