#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "common/problem.h"
#include "common/spectral/spectrum.h"

/// The words of the spectral EXR layout: A. Fichet, R. Pacanowski and A. Wilkie, An OpenEXR layout
/// for spectral images, Journal of Computer Graphics Techniques 10(3), 1 (2021).
namespace metamer {

/// What a channel of a spectral picture holds.
struct SpectralChannel {
  enum class Kind {
    emission,      ///< "S0.": radiance, the first of the Stokes components
    polarisation,  ///< "S1." to "S3.": the others
    reflectance,   ///< "T."
  };
  Kind kind = Kind::emission;
  double nm = 0;
};

/// Reads "S0.550,000000nm", with a comma or a point, in any length (nm, um or µm, m …) or frequency
/// (THz …); nothing for a channel of another sort, which has no such beginning and end. Errors: no
/// number before the unit, one that is not finite or not above 0, an unknown unit.
Result<std::optional<SpectralChannel>> parse_spectral_channel(std::string_view name);

/// "S0.550,000000nm". `nm` as parse_spectral_channel gives it.
std::string spectral_channel_name(const SpectralChannel& channel);

/// The unit of radiance in the layout's spelling where `text` means it, "W/m^2/sr" say, else
/// `text`.
std::string emissive_units(std::string_view text);
inline constexpr const char* radiance_units = "W.m^-2.sr^-1";

}  // namespace metamer
