#pragma once

#include <string>
#include <vector>

#include "common/color/xyz.h"

namespace metamer::test {

struct GaussianLine {
  double nm, width, power;  ///< width: σ.
};

/// A lamp as an instrument would have written it down.
struct Lamp {
  std::string name;
  double step;  ///< nm, of its data; 0: uneven, finer near the lines.
  double continuum;
  std::vector<GaussianLine> lines;  ///< Rising.
};

/// One of each kind, whose lines lie between whole nanometres.
const std::vector<Lamp>& lamps();

/// Its data: every wavelength is a multiple of 0.005 nm.
Spectrum samples_of(const Lamp& lamp);

/// "samples { wavelength: […] value: […] } interpolation: LINEAR": a plain sum takes straight
/// lines.
std::string text_of(const Spectrum& spectrum);

/// X Y Z of reflected light of luminance 1 as a plain sum over the middles of 0.005 nm: what all
/// integrals over cells are held against.
class PlainSum {
 public:
  /// A line (as_emission) is shared by its two neighbours.
  PlainSum(const Spectrum& light, const Observer& observer);

  static const std::vector<double>& wavelengths();
  /// A surface's values at the sum's wavelengths.
  static std::vector<double> reflectance(const Spectrum& surface);
  Xyz operator()(const std::vector<double>& reflectance) const;
  Xyz white() const;

 private:
  std::array<std::vector<double>, 3> seen_;  ///< Light × observer, of luminance 1.
};

}  // namespace metamer::test
