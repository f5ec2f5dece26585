#pragma once

#include <string>
#include <vector>

#include "common/color/lab.h"
#include "common/problem.h"
#include "common/spectral/files/spectrum_file.h"

/// Two surfaces that look alike under one light and not under another (3.1.2.2).
namespace metamer {

/// How two reflectances look under one light of luminance 1, which is the white.
struct Mismatch {
  std::string light;
  Xyz one, other, white;
  double de00, deab, deuv;
};

/// How two reflectances part when the light changes: their difference under another light once what
/// they differ by already under the first is taken away.
struct MetamerismIndex {
  double de00, deab;
};

/// The special metamerism index, change in illuminant (CIE 15:2004, 9.2; ISO 18314-4:2020): the
/// difference under `test`, where the X, Y and Z of the other are multiplied by what makes them the
/// one's under `reference`. One that is 0 there, which nothing can be multiplied to, stays as it
/// is.
MetamerismIndex metamerism_index(const Mismatch& reference, const Mismatch& test);

/// The differences under each of `lights`, integrated from 360 to 830 nm; reflectances hold their
/// end values. Error: a light that the observer does not see.
Result<std::vector<Mismatch>> metamerism(const Spectrum& one, const Spectrum& other,
                                         const std::vector<NamedSpectrum>& lights,
                                         const Observer& observer);

/// All the CIE's illuminants, for the above.
std::vector<NamedSpectrum> cie_lights();

struct Metamer {
  Spectrum reflectance;  ///< In 0..1; 360 to 830 nm by 1 nm.
  double de00;           ///< From the original, under the other light.
};

/// A reflectance in 0..1 that has the X Y Z of `original` under the light `under` (to 1e-12) and
/// lies far from it under `against`. What is added to the original is a sum of 11 cosines over 360
/// to 830 nm, so that nothing new in it is narrower than half a period of 47 nm, as in paints. ΔE00
/// is the largest that linear programmes in the metameric black space (G. Wyszecki 1953) find in 26
/// directions and by climbing from the best: a vertex of the set of all such metamers, not proven
/// the farthest. Errors: a reflectance outside 0..1, a dark light, nothing that differs by ΔE00
/// 0.001 or more (white, black, or two lights of one shape).
Result<Metamer> make_metamer(const Spectrum& original, const Spectrum& under,
                             const Spectrum& against, const Observer& observer);

}  // namespace metamer
