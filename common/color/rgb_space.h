#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "common/color/chromaticity.h"
#include "common/color/matrix3.h"
#include "common/color/xyz.h"
#include "common/problem.h"

namespace metamer {

using Rgb = Vector3;  ///< Linear, unless its name says otherwise.

struct Primaries {
  Chromaticity red, green, blue, white;
};

/// Linear → encoded: slope · x up to the knee, (1 + offset) · x^(1/gamma) − offset above it. Odd
/// for negative values and continued above 1, so that it has an inverse everywhere.
struct Transfer {
  double gamma = 1;
  double offset = 0;
  double slope = 1;
  double knee = 0;  ///< Linear; 0: there is no straight part.
};

double encode(const Transfer& transfer, double linear);
double decode(const Transfer& transfer, double encoded);

/// An RGB space: its primaries and white, what follows from them, and its transfer function.
struct RgbSpace {
  std::string word;  ///< On the command line: "display-p3".
  std::string name;  ///< For people: "Display P3".
  Primaries primaries;
  Transfer transfer;
  Matrix3 to_xyz;  ///< R = G = B = 1 is the white at Y = 1.
  Matrix3 from_xyz;
};

/// A space of any primaries; matrices after SMPTE RP 177 (1993), 3.3. Errors: a coordinate that is
/// not finite or beyond ±10, y = 0 (no X Y Z has it), primaries on a line, a white that is not
/// inside their triangle, a gamma that is not above 0.
Result<RgbSpace> make_rgb_space(std::string word, std::string name, const Primaries& primaries,
                                const Transfer& transfer);

enum class StandardSpace { srgb, display_p3, adobe_rgb, prophoto, rec_2020, cie_rgb };

const RgbSpace& rgb_space(StandardSpace space);

/// By its word; null when there is none.
const RgbSpace* find_rgb_space(std::string_view word);
std::vector<std::string> rgb_space_words();

/// X Y Z on a screen of D65 → what looks alike under the white of the space, by Bradford's matrix;
/// the identity where that white is D65, to 5e-4 in x and y. Error: that of adaptation_matrix.
Result<Matrix3> white_for_d65(const RgbSpace& space);

/// X Y Z of a chromaticity at Y = 1; y is not 0.
Xyz white_xyz(const Chromaticity& white);

}  // namespace metamer
