#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "server/scene/compiling.h"

namespace metamer {

/// The spectra of a scene that is compiled: each is loaded the first time that it is named, and has
/// its index in the scene's lists. What can't be loaded is a problem, and something stands in its
/// place.
class SpectrumLists {
 public:
  /// `to` must outlive it.
  explicit SpectrumLists(Compiling& to) : to_(to) {}

  std::uint32_t emission(const v1::Spectrum& message, const std::string& field) {
    return spectrum(message, field, SpectrumRole::emission);
  }
  std::uint32_t property(const v1::Spectrum& message, const std::string& field) {
    return spectrum(message, field, SpectrumRole::property);
  }
  /// The same at every wavelength.
  std::uint32_t property(double constant, const std::string& field);
  /// Of R, G or B (channel 0, 1, 2) alone, reflectance_of_rgb.
  std::uint32_t primary(std::size_t channel, const std::string& field);
  /// Of an exact Fresnel term.
  std::uint32_t constants(const v1::Fresnel& fresnel, const std::string& field);

 private:
  using Known = std::map<std::string, std::uint32_t>;  ///< By message.

  std::uint32_t spectrum(const v1::Spectrum& message, const std::string& field, SpectrumRole role);

  Compiling& to_;
  Known emissions_, properties_, constants_;
};

}  // namespace metamer
