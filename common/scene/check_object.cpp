#include <algorithm>
#include <array>

#include "common/scene/names.h"
#include "common/scene/parts.h"
#include "common/scene/vectors.h"

namespace metamer {

namespace {

void check_mesh(const v1::Mesh& mesh, const std::string& field, Findings& findings) {
  constexpr std::array extensions = {".ply", ".obj", ".gltf", ".glb"};
  if (mesh.file().empty()) return findings.add(field, "mesh needs a file");
  const bool known = std::any_of(extensions.begin(), extensions.end(), [&](const char* extension) {
    return has_extension(mesh.file(), extension);
  });
  if (!known) {
    findings.add(field + ".file",
                 "file must end in .ply, .obj, .gltf or .glb (it is " + quoted(mesh.file()) + ")");
  }
  if (const double angle = mesh.crease_angle(); !(angle >= 0 && angle <= 180)) {
    findings.add(field + ".crease_angle",
                 "crease_angle must be 0 to 180 degrees (it is " + number_text(angle) + ")", angle,
                 std::clamp(angle, 0.0, 180.0));
  }
}

void check_quad(const v1::Quad& quad, const std::string& field, Findings& findings) {
  const Vector u = to_vector(quad.u());
  const Vector v = to_vector(quad.v());
  if (length(u) == 0) {
    findings.add(field + ".u", "u must not be 0");
  } else if (length(v) == 0) {
    findings.add(field + ".v", "v must not be 0");
  } else if (are_parallel(u, v)) {
    findings.add(field + ".v", "v must not be parallel to u");
  }
}

void check_sphere(const v1::Sphere& sphere, const std::string& field, Findings& findings) {
  if (sphere.radius() > 0) return;
  findings.add(field + ".radius",
               "radius must be above 0 (it is " + number_text(sphere.radius()) + ")");
}

void check_plane(const v1::Plane& plane, const std::string& field, Findings& findings) {
  if (plane.has_normal() && length(to_vector(plane.normal())) == 0)
    findings.add(field + ".normal", "normal must not be 0");
}

}  // namespace

void check_object(const v1::Object& object, const std::string& field, Findings& findings) {
  if (!check_values(object, field, findings)) return;

  switch (object.shape_case()) {
    case v1::Object::kMesh:
      check_mesh(object.mesh(), field + ".mesh", findings);
      break;
    case v1::Object::kQuad:
      check_quad(object.quad(), field + ".quad", findings);
      break;
    case v1::Object::kSphere:
      check_sphere(object.sphere(), field + ".sphere", findings);
      break;
    case v1::Object::kPlane:
      check_plane(object.plane(), field + ".plane", findings);
      break;
    case v1::Object::SHAPE_NOT_SET:
      findings.add(field, "object needs a mesh, a quad, a sphere or a plane");
      break;
  }
  check_transforms(object, field, findings);
}

}  // namespace metamer
