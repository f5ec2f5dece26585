#include "common/scene/interpolated.h"

#include <cmath>

namespace metamer {
namespace {

Interpolation usual_interpolation(const Spectrum& samples, SpectrumRole role) {
  switch (role) {
    case SpectrumRole::emission:
    case SpectrumRole::excitation:
      return recommended_interpolation(samples, Outside::zero);
    case SpectrumRole::property:
      return recommended_interpolation(samples, Outside::hold);
    case SpectrumRole::reflectance:
    case SpectrumRole::index:
    case SpectrumRole::extinction:
      return Interpolation::linear;
  }
  return Interpolation::linear;
}

}  // namespace

ValueRange value_range(SpectrumRole role) {
  switch (role) {
    case SpectrumRole::emission:
      return {0, HUGE_VAL};
    case SpectrumRole::property:
      return {0, 1};
    case SpectrumRole::reflectance:
      return {0, 0.999999};
    case SpectrumRole::index:
      return {0.01, 100};
    case SpectrumRole::extinction:
      return {0, 100};
    case SpectrumRole::excitation:
      return {0, 1};
  }
  return {};
}

Result<Interpolated> interpolated(const Spectrum& samples, std::optional<Interpolation> asked,
                                  SpectrumRole role) {
  return interpolated(samples, asked ? *asked : usual_interpolation(samples, role),
                      value_range(role), observer_wavelengths().nm());
}

}  // namespace metamer
