#include "server/scene/spectrum_lists.h"

#include "common/color/rgb_reflectance.h"
#include "common/spectral/lines.h"

namespace metamer {

std::uint32_t SpectrumLists::property(double constant, const std::string& field) {
  v1::Spectrum message;
  message.set_constant(constant);
  return property(message, field);
}

std::uint32_t SpectrumLists::primary(std::size_t channel, const std::string& field) {
  const auto [place, is_new] =
      properties_.try_emplace(std::string("RGB") + "RGB"[channel],
                              static_cast<std::uint32_t>(to_.result.properties.size()));
  if (is_new) {
    Rgb primary{};
    primary[channel] = 1;
    to_.result.properties.push_back(reflectance_of_rgb(primary));
    to_.result.property_fields.push_back(field);
  }
  return place->second;
}

std::uint32_t SpectrumLists::constants(const v1::Fresnel& fresnel, const std::string& field) {
  const auto [place, is_new] = constants_.try_emplace(
      fresnel.SerializeAsString(), static_cast<std::uint32_t>(to_.result.constants.size()));
  if (is_new) {
    auto loaded = load_fresnel(fresnel, field, to_.assets);
    if (!loaded) to_.problems.push_back(std::move(loaded.error()));
    to_.result.constants.push_back(loaded ? *std::move(loaded)
                                          : OpticalConstants{Spectrum{{550}, {1}}, {}});
    to_.result.constants_fields.push_back(field);
  }
  return place->second;
}

std::uint32_t SpectrumLists::spectrum(const v1::Spectrum& message, const std::string& field,
                                      SpectrumRole role) {
  const bool emission = role == SpectrumRole::emission;
  Known& known = emission ? emissions_ : properties_;
  auto& spectra = emission ? to_.result.emissions : to_.result.properties;
  auto& fields = emission ? to_.result.emission_fields : to_.result.property_fields;
  const auto [place, is_new] =
      known.try_emplace(message.SerializeAsString(), static_cast<std::uint32_t>(spectra.size()));
  if (is_new) {
    auto loaded = load_noted_spectrum(message, field, role, to_.assets);
    if (!loaded) to_.problems.push_back(std::move(loaded.error()));
    if (loaded) to_.note(loaded->notes, field);
    Spectrum own = loaded ? std::move(loaded->spectrum) : Spectrum{{550}, {0}};
    spectra.push_back(emission ? as_emission(std::move(own)) : std::move(own));
    fields.push_back(field);
  }
  return place->second;
}

}  // namespace metamer
