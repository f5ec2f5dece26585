#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

/// Functions of wavelength from few values, by composite interpolation (Berrut and Trefethen 2004).
namespace metamer {

/// Wavelengths in panels. In each a function is taken for the polynomial through its values at the
/// panel's nodes, which are Chebyshev's of the second kind: neighbours share the one between them.
struct Panels {
  std::vector<double> edges;        ///< nm, rising; at least two.
  std::vector<std::size_t> degree;  ///< Of each panel's polynomials, 1 to max_degree.

  static constexpr std::size_t max_degree = 8;

  std::vector<double> nodes() const;  ///< Of all panels, nm, rising.
};

/// The nodes of one panel: degree + 1.
std::vector<double> panel_nodes(double from, double to, std::size_t degree);

/// What the values at a panel's nodes are worth at one place, `nm`: so many as there are nodes.
/// They sum to 1.
using Lagrange = std::array<double, Panels::max_degree + 1>;
Lagrange lagrange(double nm, std::span<const double> nodes);

}  // namespace metamer
