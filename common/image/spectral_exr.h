#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

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

/// Writes the layout of Fichet, Pacanowski and Wilkie (see spectral_names.h): a 32-bit float
/// channel for each wavelength, and R, G, B of `preview` (X Y Z, of the same size) as linear sRGB.
/// `metadata` as for write_image. Errors: an extension other than .exr, wavelengths that differ by
/// less than the six decimals of a name, a file that can't be written.
Result<void> write_spectral_exr(const SpectralImage& image, const Image& preview,
                                const std::filesystem::path& file,
                                const std::map<std::string, std::string>& metadata);

/// Reads it, sorted by wavelength: the file has its channels in the alphabet's order. Nothing where
/// the file has no spectral channel. Errors name the file: a hostile name (see
/// parse_spectral_channel), a wavelength in two channels, emission and reflectance in one file,
/// only S1. to S3., more than Wavelengths::max_count wavelengths or max_image_values values.
Result<std::optional<SpectralImage>> read_spectral_exr(const std::filesystem::path& file);

}  // namespace metamer
