#include "common/scene/parts.h"
#include "common/scene/vectors.h"

namespace metamer {

namespace {

/// Of a lens: beyond it, its rays all go along it.
constexpr double most_focus_ratio = 1e6;

}  // namespace

void check_camera(const v1::Camera& camera, const std::string& field, Findings& findings) {
  if (!check_values(camera, field, findings)) return;

  if (camera.has_vertical_fov() && !(camera.vertical_fov() > 0 && camera.vertical_fov() < 180)) {
    findings.add(field + ".vertical_fov",
                 "vertical_fov must be above 0 and below 180 degrees (it is " +
                     number_text(camera.vertical_fov()) + ")");
  }

  if (camera.aperture_radius() < 0)
    findings.add(field + ".aperture_radius",
                 "aperture_radius must not be negative (it is " +
                     number_text(camera.aperture_radius()) + ")",
                 camera.aperture_radius(), 0);
  else if (camera.has_focus_distance() &&
           camera.aperture_radius() > most_focus_ratio * camera.focus_distance())
    findings.add(field + ".aperture_radius",
                 "aperture_radius must be at most a million times the focus_distance");
  if (camera.has_focus_distance() && !(camera.focus_distance() > 0))
    findings.add(field + ".focus_distance", "focus_distance must be above 0 (it is " +
                                                number_text(camera.focus_distance()) + ")");

  const Vector view = to_vector(camera.target()) - to_vector(camera.eye());
  const Vector up = camera.has_up() ? to_vector(camera.up()) : Vector{0, 1, 0};
  if (length(view) == 0) {
    findings.add(field + ".target", "target must differ from eye");
  } else if (length(up) == 0) {
    findings.add(field + ".up", "up must not be 0");
  } else if (are_parallel(view, up)) {
    findings.add(field + ".up", camera.has_up() ? "up must not be parallel to the view"
                                                : "up must not be parallel to the view (it is +y "
                                                  "when left out)");
  }
}

}  // namespace metamer
