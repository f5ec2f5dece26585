#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "common/problem.h"

namespace metamer {

/// The sample positions of a rendering, and the width of the cell that each one stands for.
/// Immutable.
class Wavelengths {
 public:
  /// from, from + step, … up to and including `to` (within 1e-6 of a step).
  /// Errors: a number that is not finite, not positive, `to` below `from`, step not above 0, more
  /// than max_count samples.
  static Result<Wavelengths> uniform(double from, double to, double step);

  /// Any positions. Errors: none, not finite, not positive, unsorted, repeated, too many; the
  /// message names the offending pair.
  static Result<Wavelengths> listed(std::vector<double> nm);

  /// Positions with the widths that a sum over them is to have, as many: a quadrature's own.
  static Wavelengths weighted(std::vector<double> nm, std::vector<double> widths);

  static constexpr std::size_t max_count = 4001;  ///< 300 to 700 nm by 0.1 nm.

  std::size_t size() const { return nm_.size(); }
  const std::vector<double>& nm() const { return nm_; }

  /// Cell widths Δλ (nm), those of weighted() or by Fig. 4-2: inside, half the distance between
  /// both neighbours; at the ends, the distance to the one neighbour. A single wavelength has the
  /// width 1.
  const std::vector<double>& widths() const { return widths_; }

 private:
  explicit Wavelengths(std::vector<double> nm);
  Wavelengths(std::vector<double> nm, std::vector<double> widths);
  std::vector<double> nm_, widths_;
};

/// Where the CIE's observers see anything, nm (CIE 15:2004, table T.4).
inline constexpr double observer_from_nm = 360, observer_to_nm = 830;

/// All of that range by 1 nm: the grid of whatever integrates all that is seen.
Wavelengths observer_wavelengths();

/// What is wrong with sample positions, whoever they belong to: none, one that is not finite, not
/// above 0, below its predecessor or equal to it. Nothing: they are sound.
std::optional<std::string> wrong_positions(const std::vector<double>& nm);

}  // namespace metamer
