#include <google/protobuf/descriptor.h>

#include <algorithm>
#include <numbers>

#include "common/scene/check_day.h"
#include "common/scene/check_spectrum.h"
#include "common/scene/light.h"
#include "common/scene/limits.h"
#include "common/scene/names.h"
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
    const std::string name = where.field(i)->name();
    text += (name.front() == 'e' || name.front() == 'o' ? "an " : "a ") + name;
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
      case Kind::vector:
        if (length(to_vector(light.vector(one))) == 0)
          findings.add(place, std::string(one.name) + " must not be 0");
        break;
      case Kind::length:
        if (!(light.number(one) > 0))
          findings.add(place, std::string(one.name) + " must be above 0 (it is " +
                                  number_text(light.number(one)) + ")");
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

/// A quad light with no area has no light.
void check_sides(const v1::Light& light, const std::string& field, Findings& findings) {
  if (!light.has_quad()) return;
  const Vector u = to_vector(light.quad().u()), v = to_vector(light.quad().v());
  if (length(u) != 0 && length(v) != 0 && are_parallel(u, v))
    findings.add(field + ".quad.v", "v must not be parallel to u");
}

void check_solid_angle(const v1::Light& light, bool is_seen, const std::string& field,
                       Findings& findings) {
  if (!light.has_solid_angle()) return;
  constexpr double sphere = 4 * std::numbers::pi;
  const std::string message =
      "solid_angle must be above 0 and at most 4π (it is " + number_text(light.solid_angle()) + ")";
  if (is_seen)
    findings.add(field,
                 "a light with a surface has a solid angle of its own: leave solid_angle out");
  else if (!(light.solid_angle() > 0))
    findings.add(field, message);
  else if (light.solid_angle() > sphere)
    findings.add(field, message, light.solid_angle(), sphere);
}

void check_environment(const v1::Light::Environment& environment, const std::string& field,
                       Findings& findings) {
  if (!environment.file().empty() && !has_extension(environment.file(), ".exr"))
    findings.add(field + ".file",
                 "file must end in .exr (it is " + quoted(environment.file()) + ")");
  if (!environment.has_sky()) return;
  check_day(environment.sky(), field + ".sky", findings);
  if (!environment.file().empty())
    findings.add(field + ".file", "an environment has a file or a sky, not both");
}

/// A sky by day has one of its own.
void check_own_spectrum(const v1::Light& light, const std::string& field, Findings& findings) {
  const bool has_own = light.environment().has_sky();
  if (light.has_spectrum() && has_own)
    findings.add(field, "a sky has spectra of its own: leave spectrum out");
  else if (light.has_spectrum())
    check_spectrum(light.spectrum(), field, SpectrumRole::emission, findings);
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
  const bool is_seen =
      light.has_environment() || light.has_object() || (chosen.entry && chosen.entry->has_area);
  if (chosen.entry != nullptr) {
    check_parameters(chosen, field, findings);
    check_sides(light, field, findings);
  } else if (light.has_environment()) {
    check_environment(light.environment(), field + ".environment", findings);
  } else if (!light.has_object()) {
    findings.add(field, "light needs " + choices());
  }

  check_own_spectrum(light, field + ".spectrum", findings);
  if (!light.has_spectrum() && !light.environment().has_sky())
    findings.add(field, "light needs a spectrum");
  check_luminance(light.luminance(), field + ".luminance", findings);

  check_solid_angle(light, is_seen, field + ".solid_angle", findings);
  if (light.has_visible() && !is_seen && chosen.entry != nullptr)
    findings.add(field + ".visible",
                 "visible is for lights with a surface and for environments: a " +
                     std::string(chosen.entry->name) + " light is never seen");

  if (!light.has_reference_distance()) return;
  const std::string distance = field + ".reference_distance";
  if (light.has_object()) {
    findings.add(distance,
                 "reference_distance is for lights whose shape is known: the luminance is that of "
                 "the object's own surface");
  } else if (chosen.entry == nullptr ? light.has_environment() : !lights::is_local(*chosen.entry)) {
    findings.add(distance, "reference_distance is for lights with a position");
  } else if (!(light.reference_distance() > 0)) {
    findings.add(distance, "reference_distance must be above 0 (it is " +
                               number_text(light.reference_distance()) + ")");
  } else if (light.has_sphere() &&
             chosen.number(chosen.entry->parameters.back()) >= light.reference_distance()) {
    findings.add(distance, "reference_distance must be more than the sphere's radius");
  }
}

}  // namespace metamer
