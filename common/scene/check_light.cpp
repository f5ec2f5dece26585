#include <numbers>

#include "common/scene/check_spectrum.h"
#include "common/scene/limits.h"
#include "common/scene/parts.h"
#include "common/scene/vectors.h"

namespace metamer {

void check_light(const v1::Light& light, const std::string& field, Findings& findings) {
  if (!check_values(light, field, findings)) return;

  switch (light.where_case()) {
    case v1::Light::kPosition:
      break;
    case v1::Light::kDirection:
      if (length(to_vector(light.direction())) == 0) {
        findings.add(field + ".direction", "direction must not be 0");
      }
      break;
    case v1::Light::WHERE_NOT_SET:
      findings.add(field, "light needs a position or a direction");
      break;
  }

  if (light.has_spectrum()) {
    check_spectrum(light.spectrum(), field + ".spectrum", SpectrumRole::emission, findings);
  } else {
    findings.add(field, "light needs a spectrum");
  }
  if (light.luminance() < 0) {
    findings.add(field + ".luminance",
                 "luminance must not be negative (it is " + number_text(light.luminance()) + ")");
  } else if (light.luminance() != 0) {
    check_range(light.luminance(), limits::min_luminance, limits::max_luminance,
                field + ".luminance", findings);
  }

  if (light.has_solid_angle()) {
    constexpr double sphere = 4 * std::numbers::pi;
    if (!(light.solid_angle() > 0 && light.solid_angle() <= sphere)) {
      findings.add(field + ".solid_angle", "solid_angle must be above 0 and at most 4π (it is " +
                                               number_text(light.solid_angle()) + ")");
    }
  }

  if (!light.has_reference_distance()) return;
  const std::string distance = field + ".reference_distance";
  if (light.has_direction()) {
    findings.add(distance, "reference_distance is for lights with a position");
  } else if (!(light.reference_distance() > 0)) {
    findings.add(distance, "reference_distance must be above 0 (it is " +
                               number_text(light.reference_distance()) + ")");
  }
}

}  // namespace metamer
