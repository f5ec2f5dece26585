#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/spectral/spectrum.h"

/// What measured data are between their samples. A Spectrum is straight lines: what is curved is
/// given more samples once, where it is read.
namespace metamer {

enum class Interpolation { linear, sprague, monotone_cubic };

/// "linear", "sprague", "monotone-cubic", in the enum's order.
const std::vector<std::string>& interpolation_words();
std::optional<Interpolation> find_interpolation(std::string_view word);
const std::string& word_of(Interpolation interpolation);

/// What keeps samples from being interpolated so; nothing: they can be.
std::optional<std::string> interpolation_fault(const Spectrum& samples,
                                               Interpolation interpolation);

/// What values may be, both ends included.
struct ValueRange {
  double low, high;
};

struct Interpolated {
  Spectrum spectrum;
  Interpolation interpolation = Interpolation::linear;
  /// Stretches between two samples whose straight line holds, as the curve leaves the range there.
  std::size_t straight = 0;
};

/// The samples, to the bit, and between them the interpolant's values at those of `nm` (rising)
/// that lie there: straight lines between these are the result. Where it leaves `range` at one of
/// them, none of that stretch between two samples is taken. Error: interpolation_fault().
Result<Interpolated> interpolated(const Spectrum& samples, Interpolation interpolation,
                                  const ValueRange& range, const std::vector<double>& nm);

/// What data are read as where nobody says: CIE 167:2005 has Sprague's interpolation for even
/// samples, here where they are more than 1 nm apart and at least 6, and a cubic for uneven ones,
/// here a monotone one, which does not overshoot, where their median distance is above 1 nm.
/// Everything else is straight lines, and so are emissions with lines or steps, of which no
/// polynomial knows the shape: CIE 15 has those of F1 to F12 so.
Interpolation recommended_interpolation(const Spectrum& samples, Outside outside);

/// How far an interpolant lies from the straight lines between the samples, at the whole
/// nanometres that are seen; a share of the largest sample there. Error as
/// above.
Result<double> curvature(const Spectrum& samples, Interpolation interpolation);

/// Above it an emission has lines or steps. By 5 nm the largest of D50 to D93, A, B, C and LEDs of
/// 20 nm and more is 0.048, the least of F1 to F12 0.092.
inline constexpr double smooth_curvature = 0.05;

}  // namespace metamer
