#include "common/color/chain_bands.h"

#include <algorithm>

namespace metamer {
namespace {

bool is_grey(const Spectrum& spectrum) {
  const auto [least, most] = std::minmax_element(spectrum.values.begin(), spectrum.values.end());
  return *least == *most;
}

}  // namespace

ChainBands::ChainBands(const std::vector<Spectrum>& curves, unsigned times,
                       const std::vector<const Spectrum*>& surfaces,
                       const std::vector<SeenLight>& lights,
                       const std::vector<const Spectrum*>& once)
    : edges(bend_edges(surfaces, lights)) {
  std::vector<const Spectrum*> coloured;
  for (const Spectrum& curve : curves)
    if (!is_grey(curve)) coloured.push_back(&curve);
  curve_count = coloured.size();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    panels[axis] = chain_panels(coloured, times, lights, axis, once);
    const std::vector<double> nodes = panels[axis].nodes();
    nm.insert(nm.end(), nodes.begin(), nodes.end());
    first[axis + 1] = nm.size();
  }
}

SurfaceSensors::SurfaceSensors(const SeenLight& light, const ChainBands& bands)
    : bands_(bands.nm.size()) {
  for (std::size_t axis = 0; axis < 3; ++axis)
    add(light.density[axis], light.cells, bands.panels[axis], bands.first[axis], bands.edges);
}

void SurfaceSensors::add(const std::vector<double>& density, const Wavelengths& cells,
                         const Panels& panels, std::size_t band, const std::vector<double>& edges) {
  const std::vector<double> nodes = panels.nodes();
  std::size_t panel = 0, first = 0, edge = 0;
  bool is_new = true;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    // Find the piece that the point lies in.
    const double x = cells.nm()[k];
    for (; x > panels.edges[panel + 1]; is_new = true) first += panels.degree[panel++];
    for (; x > edges[edge + 1]; is_new = true) ++edge;
    const std::size_t degree = panels.degree[panel];
    if (is_new) pieces_.push_back({edge, band + first, degree, {}, {}});
    is_new = false;

    const double amount = density[k] * cells.widths()[k];
    const double t = (x - edges[edge]) / (edges[edge + 1] - edges[edge]);
    const Lagrange worth = lagrange(x, std::span(nodes).subspan(first, degree + 1));
    for (std::size_t i = 0; i <= degree; ++i) {
      pieces_.back().left[i] += (1 - t) * amount * worth[i];
      pieces_.back().right[i] += t * amount * worth[i];
    }
  }
}

std::vector<double> SurfaceSensors::of(std::span<const float> surface) const {
  std::vector<double> sensors(bands_);
  for (const Piece& piece : pieces_) {
    const double left = double{surface[piece.edge]}, right = double{surface[piece.edge + 1]};
    for (std::size_t i = 0; i <= piece.degree; ++i)
      sensors[piece.band + i] += left * piece.left[i] + right * piece.right[i];
  }
  return sensors;
}

}  // namespace metamer
