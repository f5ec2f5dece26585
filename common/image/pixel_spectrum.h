#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "common/image/read_exr.h"
#include "common/spectral/files/spectrum_file.h"

/// Spectra of pictures: the pixels of a spectral EXR.
namespace metamer {

inline constexpr std::uint64_t max_spectral_picture = 256u << 20;  ///< A megapixel of 64 bands.

/// Whether a file is called as a picture is, .exr.
bool is_picture_of_spectra(const std::string& file);

/// The spectrum of the pixel "10x20", counted from the upper left, or the mean over the rectangle
/// "10x20-30x40", both corners in it; it has the entry's name. Of the picture no more is read than
/// that. Errors name the file: those of read_spectral_layer, a picture without spectra, no entry or
/// one that lies outside.
Result<SpectrumFile> read_pixel_spectrum(const PictureSource& source,
                                         const std::optional<std::string>& entry);

}  // namespace metamer
