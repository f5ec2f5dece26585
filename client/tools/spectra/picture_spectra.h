#pragma once

#include <optional>
#include <string>

#include "common/problem.h"
#include "common/spectral/files/spectrum_file.h"

/// Spectra of pictures: the pixels of a spectral EXR.
namespace metamer::client {

/// Whether a file is called as a picture is, .exr.
bool is_picture_of_spectra(const std::string& file);

/// The spectrum of the pixel "10x20", counted from the upper left, or the mean over the rectangle
/// "10x20-30x40", both corners in it; it has the entry's name. Errors name the file: those of
/// read_spectral_exr, a picture without spectra, no entry or one that lies outside.
Result<SpectrumFile> read_picture_spectrum(const std::string& file,
                                           const std::optional<std::string>& entry);

}  // namespace metamer::client
