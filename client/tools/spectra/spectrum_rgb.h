#pragma once

#include <string>

#include "client/tools/spectra/spectra_files.h"
#include "common/color/rgb_space.h"
#include "common/color/table_weights.h"
#include "common/spectral/cie.h"
#include "metamer/v1/scene.pb.h"

/// Trichromatic values of spectra (4.7.1).
namespace metamer::client {

struct SpectrumRgb {
  Xyz xyz;
  Rgb linear, encoded;    ///< Of `space`; the same where the development is linear.
  bool in_gamut = false;  ///< `linear` lies in 0..1, to rounding.
  bool dark = false;      ///< Its light is: all is 0.
  RgbSpace space;
  std::string unadapted;    ///< Why the adaptation that was asked for can't be done; empty: it can.
  std::string shown_white;  ///< What a white other than D65 makes of it; empty: nothing.
};

/// A light of this luminance, or a reflectance under `light` of this luminance, developed as a
/// picture that it alone lights. `luminance` is finite and above 0. Errors: a space that there
/// can't be, those of weights_under.
Result<SpectrumRgb> spectrum_rgb(const LoadedSpectrum& one, const Spectrum& light,
                                 const Observer& observer, double luminance,
                                 const v1::Development& development,
                                 TableWeights weights = TableWeights::lines);

}  // namespace metamer::client
