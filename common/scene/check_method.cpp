#include "common/scene/check_method.h"

#include "common/scene/check_wavelengths.h"
#include "common/scene/limits.h"
#include "common/scene/settings.h"

namespace metamer {

namespace {

void check_uniform(const v1::Point& point, const std::string& field, Findings& findings) {
  if (!point.has_from() || !point.has_to() || !point.has_step()) {
    return findings.add(field, "point needs from, to and step together");
  }
  const std::size_t before = findings.size();
  for (const auto& [name, nm] : {std::pair{"from", point.from()}, std::pair{"to", point.to()}}) {
    check_range(nm, limits::min_wavelength, limits::max_wavelength, field + "." + name, findings);
  }
  if (!(point.step() > 0)) {
    findings.add(field + ".step", "step must be above 0 (it is " + number_text(point.step()) + ")");
  }
  if (findings.size() > before) return;

  if (point.to() < point.from()) {
    return findings.add(field + ".to", "to must not be below from (" + number_text(point.to()) +
                                           " is below " + number_text(point.from()) + ")");
  }
  const auto wavelengths = point_wavelengths(point);
  if (!wavelengths) findings.add(field, wavelengths.error().message);
}

}  // namespace

void check_point(const v1::Method& method, const std::string& field, Findings& findings) {
  const v1::Point& point = method.point();
  const bool uniform = point.has_from() || point.has_to() || point.has_step();
  const bool listed = !point.wavelengths().empty();
  if (point.has_fitted()) {
    if (uniform || listed)
      return findings.add(field, "fitted excludes from, to, step and wavelengths");
    check_range(point.fitted(), 1, limits::max_fitted, field + ".fitted", findings);
  } else if (uniform && listed) {
    findings.add(field, "point takes either from, to and step or wavelengths, not both");
  } else if (uniform) {
    check_uniform(point, field, findings);
  } else if (listed) {
    check_wavelengths({point.wavelengths().begin(), point.wavelengths().end()},
                      field + ".wavelengths", findings);
  }
}

void check_linear(const v1::Method& method, const std::string& field, Findings& findings) {
  check_range(method.linear().bases(), 1, limits::max_bases, field + ".bases", findings);
}

void check_goal(const v1::Goal& goal, const std::string& field, Findings& findings) {
  const bool tolerance = goal.goal_case() == v1::Goal::kTolerance;
  const double value = tolerance ? goal.tolerance() : goal.deadline();
  const std::string name = tolerance ? "tolerance" : "deadline";
  if (!(value > 0))
    findings.add(field + "." + name, name + " must be above 0 (it is " + number_text(value) + ")");
}

}  // namespace metamer
