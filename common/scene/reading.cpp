#include "common/scene/reading.h"

namespace metamer {
namespace {

std::optional<Quantity> quantity_of(const v1::Reading& message) {
  if (message.as() == v1::Reading::REFLECTANCE) return Quantity::reflectance;
  if (message.as() == v1::Reading::TRANSMITTANCE) return Quantity::transmittance;
  if (message.as() == v1::Reading::EMISSION) return Quantity::emission;
  return std::nullopt;
}

std::optional<WavelengthUnit> unit_of(const v1::Reading& message) {
  if (message.unit() == v1::Reading::NM) return WavelengthUnit::nm;
  if (message.unit() == v1::Reading::UM) return WavelengthUnit::um;
  return std::nullopt;
}

std::optional<Scale> scale_of_message(const v1::Reading& message) {
  if (message.scale() == v1::Reading::ONE) return Scale::one;
  if (message.scale() == v1::Reading::PERCENT) return Scale::percent;
  return std::nullopt;
}

}  // namespace

Reading reading_of(const v1::Reading& message) {
  return {.as = quantity_of(message),
          .unit = unit_of(message),
          .scale = scale_of_message(message),
          .clamp = message.clamp()};
}

v1::Reading to_message(const Reading& reading) {
  v1::Reading message;
  if (reading.as)
    message.set_as(*reading.as == Quantity::emission        ? v1::Reading::EMISSION
                   : *reading.as == Quantity::transmittance ? v1::Reading::TRANSMITTANCE
                                                            : v1::Reading::REFLECTANCE);
  if (reading.unit)
    message.set_unit(*reading.unit == WavelengthUnit::um ? v1::Reading::UM : v1::Reading::NM);
  if (reading.scale)
    message.set_scale(*reading.scale == Scale::percent ? v1::Reading::PERCENT : v1::Reading::ONE);
  message.set_clamp(reading.clamp);
  return message;
}

Result<Interpreted> as_role(const SpectrumFile& file, NamedSpectrum spectrum,
                            const Reading& reading, SpectrumRole role) {
  switch (role) {
    case SpectrumRole::emission:
      return interpret(file, std::move(spectrum), reading, Use::emission);
    case SpectrumRole::property:
    case SpectrumRole::reflectance:
      return interpret(file, std::move(spectrum), reading, Use::property);
    case SpectrumRole::index:
    case SpectrumRole::extinction:
    case SpectrumRole::excitation:
      break;
  }
  return Interpreted{.spectrum = std::move(spectrum.spectrum), .quantity = Quantity::reflectance};
}

}  // namespace metamer
