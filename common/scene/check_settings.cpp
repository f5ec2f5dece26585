#include "common/scene/check_wavelengths.h"
#include "common/scene/development.h"
#include "common/scene/limits.h"
#include "common/scene/parts.h"
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

void check_point(const v1::Point& point, const std::string& field, Findings& findings) {
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

void check_auto(const v1::Auto& goal, const std::string& field, Findings& findings) {
  const bool tolerance = goal.goal_case() == v1::Auto::kTolerance;
  const double value = tolerance ? goal.tolerance() : goal.deadline();
  const std::string name = tolerance ? "tolerance" : "deadline";
  if (!(value > 0))
    findings.add(field + "." + name, name + " must be above 0 (it is " + number_text(value) + ")");
}

void check_picture(const v1::Settings& full, const std::string& field, Findings& findings) {
  check_range(full.width(), 1, limits::max_side, field + ".width", findings);
  check_range(full.height(), 1, limits::max_side, field + ".height", findings);
}

/// Its other values are those of enums, which check_values knows.
void check_development(const v1::Development& development, const std::string& field,
                       Findings& findings) {
  const Result<RgbSpace> space = to_rgb_space(development);
  if (!space) findings.add(field + "." + space.error().field, space.error().message);
}

}  // namespace

void check_settings(const v1::Settings& settings, const std::string& field, Findings& findings) {
  if (!check_values(settings, field, findings)) return;

  const v1::Settings full = with_defaults(settings);
  check_picture(full, field, findings);
  switch (full.method().method_case()) {
    case v1::Method::kPoint:
      check_point(full.method().point(), field + ".method.point", findings);
      break;
    case v1::Method::kAuto:
      check_auto(full.method().auto_(), field + ".method.auto", findings);
      break;
    case v1::Method::kLinear:
      check_range(full.method().linear().bases(), 1, limits::max_bases,
                  field + ".method.linear.bases", findings);
      break;
    case v1::Method::kRgb:
    case v1::Method::kExact:
    case v1::Method::kPrefilter:
    case v1::Method::METHOD_NOT_SET:
      break;
  }
  check_development(full.development(), field + ".development", findings);
  check_range(full.spp(), 1, limits::max_spp, field + ".spp", findings);
  check_range(full.depth(), 0, limits::max_depth, field + ".depth", findings);
  check_range(full.threads(), 0, limits::max_threads, field + ".threads", findings);
  if (full.tile_size() % 8 != 0 || full.tile_size() < 8 || full.tile_size() > limits::max_tile) {
    findings.add(field + ".tile_size", "tile_size must be a multiple of 8 in 8.." +
                                           std::to_string(limits::max_tile) + " (it is " +
                                           std::to_string(full.tile_size()) + ")");
  }
}

}  // namespace metamer
