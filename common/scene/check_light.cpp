#include <google/protobuf/descriptor.h>

#include <algorithm>
#include <numbers>

#include "common/scene/check_spectrum.h"
#include "common/scene/light.h"
#include "common/scene/limits.h"
#include "common/scene/parts.h"
#include "common/scene/vectors.h"

namespace metamer {

namespace {

/// "a position, a direction or a spot".
std::string choices() {
  const auto& where = *v1::Light::descriptor()->FindOneofByName("where");
  std::string text;
  for (int i = 0; i < where.field_count(); ++i) {
    if (i > 0) text += i + 1 == where.field_count() ? " or " : ", ";
    text += "a " + where.field(i)->name();
  }
  return text;
}

void check_parameters(const ChosenLight& light, const std::string& field, Findings& findings) {
  using Kind = lights::Parameter::Kind;
  for (const lights::Parameter& one : light.entry->parameters) {
    const std::string place =
        field + (light.is_vector() ? "." : "." + std::string(light.entry->name) + ".") + one.name;
    switch (one.kind) {
      case Kind::position:
        break;
      case Kind::direction:
        if (length(to_vector(light.vector(one))) == 0)
          findings.add(place, std::string(one.name) + " must not be 0");
        break;
      case Kind::angle:
      case Kind::number:
        const double value = light.number(one);
        if (value >= one.min && value <= one.max) break;
        const double nearest = std::clamp<double>(value, one.min, one.max);
        findings.add(place,
                     std::string(one.name) + " must lie in " + number_text(one.min) + ".." +
                         number_text(one.max) + " (it is " + number_text(value) +
                         "); the nearest allowed value is " + number_text(nearest),
                     value, nearest);
        break;
    }
  }
}

}  // namespace

void check_luminance(double luminance, const std::string& field, Findings& findings) {
  if (luminance < 0) {
    findings.add(field, "luminance must not be negative (it is " + number_text(luminance) + ")",
                 luminance, 0);
  } else if (luminance != 0) {
    check_range(luminance, limits::min_luminance, limits::max_luminance, field, findings);
  }
}

void check_light(const v1::Light& light, const std::string& field, Findings& findings) {
  if (!check_values(light, field, findings)) return;

  const ChosenLight chosen = chosen_light(light);
  if (chosen.entry != nullptr) {
    check_parameters(chosen, field, findings);
  } else {
    findings.add(field, "light needs " + choices());
  }

  if (light.has_spectrum()) {
    check_spectrum(light.spectrum(), field + ".spectrum", SpectrumRole::emission, findings);
  } else {
    findings.add(field, "light needs a spectrum");
  }
  check_luminance(light.luminance(), field + ".luminance", findings);

  if (light.has_solid_angle()) {
    constexpr double sphere = 4 * std::numbers::pi;
    const std::string message = "solid_angle must be above 0 and at most 4π (it is " +
                                number_text(light.solid_angle()) + ")";
    if (!(light.solid_angle() > 0)) {
      findings.add(field + ".solid_angle", message);
    } else if (light.solid_angle() > sphere) {
      findings.add(field + ".solid_angle", message, light.solid_angle(), sphere);
    }
  }

  if (!light.has_reference_distance()) return;
  const std::string distance = field + ".reference_distance";
  if (chosen.entry != nullptr && !lights::is_local(*chosen.entry)) {
    findings.add(distance, "reference_distance is for lights with a position");
  } else if (!(light.reference_distance() > 0)) {
    findings.add(distance, "reference_distance must be above 0 (it is " +
                               number_text(light.reference_distance()) + ")");
  }
}

}  // namespace metamer
