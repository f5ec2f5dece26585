#include <algorithm>
#include <cmath>

#include "common/mesh/normals/vertex_averages.h"
#include "common/mesh/smooth_normals.h"

namespace metamer {
namespace {

/// A triangle's direction of rising u, of any length; 0 where its UVs are not finite or span no
/// area: a file may name UVs for some of its faces, or the same one everywhere.
Double3 rising_u(const Double3& ab, const Double3& ac, const Float2& a, const Float2& b,
                 const Float2& c) {
  const double bu = double{b[0]} - double{a[0]}, bv = double{b[1]} - double{a[1]};
  const double cu = double{c[0]} - double{a[0]}, cv = double{c[1]} - double{a[1]};
  const double area = bu * cv - bv * cu;
  const double sides = std::hypot(bu, bv) * std::hypot(cu, cv);
  if (!(std::abs(area) > 1e-6 * sides)) return {};  // NaN is no area, either.
  Double3 direction;
  for (std::size_t k = 0; k < 3; ++k) direction[k] = (ab[k] * cv - ac[k] * bv) / area;
  return direction;
}

/// A direction in the plane of a normal, unit; 0: it has none.
Float3 along_surface(const Double3& direction, const Float3& normal) {
  const Double3 n{normal[0], normal[1], normal[2]};
  const double height = dot(direction, n);
  return unit_or_none(
      {direction[0] - height * n[0], direction[1] - height * n[1], direction[2] - height * n[2]});
}

}  // namespace

std::vector<Float3> tangents_of(const MeshFile& mesh) {
  if (mesh.uvs.empty()) return {};
  const double step = rounding_of(mesh);
  std::vector<Float3> tangents = vertex_averages(
      mesh, {},
      [&](std::size_t i) -> CornerAngles {
        const auto& [a, b, c] = mesh.triangles[i];
        const Double3 at = position(mesh, a), ab = position(mesh, b) - at,
                      ac = position(mesh, c) - at;
        const Double3 u = rising_u(ab, ac, mesh.uvs[a], mesh.uvs[b], mesh.uvs[c]);
        const double length = std::sqrt(dot(u, u));
        if (!(length > 0 && std::isfinite(length))) return {};
        return {.normal = {u[0] / length, u[1] / length, u[2] / length},
                .angles = corner_angles(at, position(mesh, b), position(mesh, c), step).angles};
      },
      [&](std::size_t i, const Double3& sum) {
        return along_surface(sum, mesh.normals.empty() ? Float3{} : mesh.normals[i]);
      });
  const bool any = std::any_of(tangents.begin(), tangents.end(),
                               [](const Float3& tangent) { return tangent != Float3{}; });
  return any ? tangents : std::vector<Float3>();
}

}  // namespace metamer
