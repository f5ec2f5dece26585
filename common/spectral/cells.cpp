#include "common/spectral/cells.h"

#include <algorithm>
#include <cmath>

#include "common/spectral/lines.h"

namespace metamer {

std::vector<double> cell_edges(const std::vector<const Spectrum*>& spectra) {
  std::vector<double> edges = observer_wavelengths().nm();
  std::vector<double> both;
  for (const Spectrum* spectrum : spectra) {
    const std::vector<double>& nm = spectrum->nm;
    const auto first = std::upper_bound(nm.begin(), nm.end(), observer_from_nm);
    both.clear();
    std::set_union(edges.begin(), edges.end(), first,
                   std::lower_bound(first, nm.end(), observer_to_nm), std::back_inserter(both));
    edges.swap(both);
  }
  if (edges.size() <= max_cells + 1) return edges;

  // Keep an edge only where it is far enough from the one kept before.
  constexpr double narrowest = (observer_to_nm - observer_from_nm) / max_cells;
  std::vector<double> kept = {edges.front()};
  for (const double nm : edges)
    if (nm - kept.back() >= narrowest && observer_to_nm - nm >= narrowest) kept.push_back(nm);
  kept.push_back(edges.back());
  return kept;
}

Wavelengths cells_of(const std::vector<const Spectrum*>& spectra) {
  const double offset = 0.5 / std::sqrt(3);
  const std::vector<double> edges = cell_edges(spectra);
  std::vector<double> nm, widths;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    const double width = edges[i + 1] - edges[i], middle = edges[i] + width / 2;
    for (const double sign : {-1, 1}) {
      nm.push_back(middle + sign * offset * width);
      widths.push_back(width / 2);
    }
  }
  return Wavelengths::weighted(std::move(nm), std::move(widths));
}

std::vector<double> shares(const std::vector<double>& density, const Wavelengths& cells,
                           const std::vector<double>& nm, Outside outside) {
  std::vector<double> result(nm.size());
  std::size_t right = 0;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const double x = cells.nm()[k], amount = density[k] * cells.widths()[k];
    while (right < nm.size() && nm[right] < x) ++right;
    if (right == 0 || right == nm.size()) {
      if (outside == Outside::hold) result[right == 0 ? 0 : nm.size() - 1] += amount;
      continue;
    }
    const double t = (x - nm[right - 1]) / (nm[right] - nm[right - 1]);
    result[right - 1] += (1 - t) * amount;
    result[right] += t * amount;
  }
  return result;
}

std::vector<double> light_shares(const Spectrum& emission, const std::vector<double>& nm) {
  const Spectrum at{nm, nm};
  const Wavelengths cells = cells_of({&emission, &at});
  return shares(resample(emission, cells.nm(), Outside::zero).values, cells, nm, Outside::zero);
}

std::vector<double> mean_power(const Spectrum& emission, const Wavelengths& wavelengths) {
  std::vector<double> mean = light_shares(emission, wavelengths.nm());
  for (std::size_t i = 0; i < mean.size(); ++i) mean[i] /= wavelengths.widths()[i];
  return mean;
}

std::vector<double> hat_widths(const std::vector<double>& nm) {
  if (nm.size() == 1) return {1};
  std::vector<double> widths(nm.size());
  for (std::size_t i = 0; i + 1 < nm.size(); ++i) {
    widths[i] += (nm[i + 1] - nm[i]) / 2;
    widths[i + 1] += (nm[i + 1] - nm[i]) / 2;
  }
  return widths;
}

std::vector<double> band_means(const Spectrum& emission, const std::vector<double>& nm) {
  if (nm.size() == 1) return resample(emission, nm, Outside::zero).values;
  std::vector<double> means = light_shares(as_emission(emission), nm);
  const std::vector<double> widths = hat_widths(nm);
  for (std::size_t i = 0; i < means.size(); ++i) means[i] /= widths[i];
  return means;
}

}  // namespace metamer
