#include "common/color/seen_light.h"

#include <boost/math/quadrature/gauss.hpp>

#include "common/spectral/lines.h"

namespace metamer {
namespace {

Wavelengths gauss_cells(const std::vector<double>& edges) {
  using Gauss = boost::math::quadrature::gauss<double, 4>;  // its positive half
  std::vector<double> nm, widths;
  for (std::size_t i = 0; i + 1 < edges.size(); ++i) {
    const double half = (edges[i + 1] - edges[i]) / 2, middle = edges[i] + half;
    for (const int k : {-2, -1, 1, 2}) {
      const auto at = static_cast<std::size_t>(std::abs(k) - 1);
      nm.push_back(middle + (k < 0 ? -half : half) * Gauss::abscissa()[at]);
      widths.push_back(half * Gauss::weights()[at]);
    }
  }
  return Wavelengths::weighted(std::move(nm), std::move(widths));
}

Wavelengths cells_of_light(const Observer& observer, const Spectrum& light,
                           const std::vector<double>& edges) {
  const Spectrum at{edges, edges};
  return gauss_cells(cell_edges(with_observer(observer, {&light, &at})));
}

}  // namespace

SeenLight::SeenLight(const Observer& observer, const Spectrum& emission,
                     const std::vector<double>& edges)
    : cells(cells_of_light(observer, as_emission(emission), edges)) {
  const std::vector<double> power =
      resample(as_emission(emission), cells.nm(), Outside::zero).values;
  const ObserverWeights eye = observer_weights(observer, cells);
  const double scale = luminance_scale(eye, power, 1);
  for (std::size_t axis = 0; axis < density.size(); ++axis) {
    density[axis] = eye.weights[axis];
    for (std::size_t i = 0; i < power.size(); ++i)
      density[axis][i] *= scale * power[i] / cells.widths()[i];
  }
}

}  // namespace metamer
