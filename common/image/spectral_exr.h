#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "common/image/exr_layers.h"
#include "common/image/image.h"
#include "common/image/spectral_names.h"

namespace metamer {

/// A picture with a spectrum in each pixel.
struct SpectralImage {
  int width = 0;
  int height = 0;
  bool reflectance = false;   ///< Else emission: radiance, relative or in `units`.
  std::vector<double> nm;     ///< Rising.
  std::vector<float> values;  ///< width × height × nm.size(), row by row from the top.
  /// Of emission, in the layout's spelling where it is known; empty: the file says none.
  std::string units;
  bool polarised = false;  ///< The file has S1. to S3. too, which are left aside.
};

/// Of an emission: what a band's value is, its unit, and how to come to cd/m²; in the attributes
/// "metamer:bands" and "metamer:unit" of every file that is written.
inline constexpr const char* band_text =
    "each value is the mean of the light over a hat: 1 at the channel's wavelength, 0 at the "
    "neighbouring channels'";
inline constexpr const char* unit_text =
    "spectral radiance per nm, relative to luminance Y = 1: the integral of value times ybar over "
    "nm. "
    "Taken for W m^-2 sr^-1 nm^-1, Y = 1 is 683 cd/m^2 (683 lm/W); a scene whose Y = 1 stands for "
    "L "
    "cd/m^2 has L/683 times these values";

/// Writes the layout of Fichet, Pacanowski and Wilkie (see spectral_names.h): a 32-bit float
/// channel for each wavelength, and R, G, B of `preview` (X Y Z, of the same size) as linear sRGB.
/// `metadata` as for write_image. Errors: an extension other than .exr, wavelengths that differ by
/// less than the six decimals of a name, a file that can't be written.
Result<void> write_spectral_exr(const SpectralImage& image, const Image& preview,
                                const std::filesystem::path& file,
                                const std::map<std::string, std::string>& metadata);

/// Reads it, or the pixels `only` of it, sorted by wavelength: the file has its channels in the
/// alphabet's order. `layer` is one of spectra that find_layers found. Errors name the file: those
/// of read_exr, a hostile name (see parse_spectral_channel), a wavelength in two channels, emission
/// and reflectance in one layer, only S1. to S3., more than Wavelengths::max_count wavelengths.
Result<SpectralImage> read_spectral_layer(const PictureSource& source,
                                          const std::vector<ExrPart>& parts, const ExrLayer& layer,
                                          const std::optional<PixelWindow>& only = {});

/// The same of a file's only spectra; nothing where it has none.
Result<std::optional<SpectralImage>> read_spectral_exr(const std::filesystem::path& file);

}  // namespace metamer
