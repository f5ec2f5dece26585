#pragma once

#include <filesystem>
#include <string>

#include "common/color/table_weights.h"
#include "common/image/exr_layers.h"
#include "common/image/image.h"
#include "common/spectral/cie.h"

namespace metamer {

/// How spectra become X Y Z.
struct Viewing {
  Observer observer = cie::observer_1931();
  const Spectrum* under = nullptr;  ///< What lights a reflectance, at luminance 1; null: nothing.
  TableWeights weights = TableWeights::lines;  ///< What a reflectance is between its bands.
};

/// A picture as X Y Z, whatever its file holds.
struct XyzPicture {
  Image image;
  std::string what;     ///< What the file holds: "sRGB", "a reflectance at 31 wavelengths".
  std::string units;    ///< Of an emission, as SpectralImage has them; else empty.
  bool lit = false;     ///< `Viewing::under` had a part in it.
  bool chosen = false;  ///< The PictureChoice had a part in it.
  std::vector<std::string> notes;  ///< What was guessed or left aside, a sentence each.
};

/// Reads
///   - a .png by its cICP, ICC profile, sRGB, gAMA and cHRM, in this order (png_encoding, icc.h),
///     as sRGB where it has none; grey is R = G = B; RGB of a space whose white is not D65 is read
///     as it looks on a screen of D65 (white_for_d65); transparent pixels are seen over black;
///   - an .exr's layer that `choice` means (choose_layer), over its display window:
///       - X, Y, Z as they are;
///       - R, G, B as linear, by its part's chromaticities, by sRGB's where it names none;
///       - Y as a grey;
///       - spectra (see spectral_exr.h) through the observer: an emission as band means
///         (observer_of_bands), a reflectance lit by `under` with `weights`.
/// Errors name the file: those of read_png, png_encoding, IccReader, choose_layer, read_exr and
/// read_spectral_layer, chromaticities that make no RGB space, those of weights_under, a
/// reflectance where nothing lights it.
Result<XyzPicture> read_xyz(const std::filesystem::path& file, const Viewing& viewing,
                            const PictureChoice& choice = {});

}  // namespace metamer
