#pragma once

#include "common/color/chain_panels.h"

namespace metamer {

/// Where `chains`, the products of what light meets on its way, and the surfaces that it comes
/// from are known. X, Y and Z have bands of their own: those of X come first, then those of Y and
/// of Z.
struct ChainBands {
  ChainBands() = default;
  /// Chains are of up to `times` of `curves` and one of `once`; each of `surfaces` is a line
  /// between its samples.
  ChainBands(const std::vector<Spectrum>& curves, unsigned times,
             const std::vector<const Spectrum*>& surfaces, const std::vector<SeenLight>& lights,
             const std::vector<const Spectrum*>& once = {});

  std::array<Panels, 3> panels;
  std::vector<double> nm;              ///< Of the bands, the nodes of the panels.
  std::array<std::size_t, 4> first{};  ///< Band of X, Y and Z; then their count.
  std::vector<double> edges;           ///< Between which surfaces are lines, nm.
  std::size_t curve_count = 0;         ///< Of those that are not grey.
};

/// What an observer sees of a light that comes from any surface, by band:
///
///     X = Σᵢ sensorᵢ chainᵢ over the bands of X,   sensorᵢ = ∫ light · x̄ · surface · ℓᵢ dλ
///
/// and so Y and Z, where ℓᵢ is the polynomial that is 1 at the band and 0 at the panel's others.
class SurfaceSensors {
 public:
  SurfaceSensors(const SeenLight& light, const ChainBands& bands);

  /// A sensor a band; `surface` has a value for each of bands.edges.
  std::vector<double> of(std::span<const float> surface) const;

 private:
  /// A part of a panel within which surfaces are lines: what its ends are worth to the panel's
  /// bands.
  struct Piece {
    std::size_t edge;  ///< Its left one.
    std::size_t band;  ///< The panel's first.
    std::size_t degree;
    Lagrange left, right;
  };
  void add(const std::vector<double>& density, const Wavelengths& cells, const Panels& panels,
           std::size_t band, const std::vector<double>& edges);

  std::size_t bands_;
  std::vector<Piece> pieces_;
};

}  // namespace metamer
