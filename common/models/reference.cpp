#include "common/models/reference.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-parameter"

namespace metamer::models {
namespace f64 {
namespace {
using Real = double;
/// One number that is indexed like eight.
struct Wide {
  double value;
  double& operator[](int) { return value; }
  double operator[](int) const { return value; }
};
constexpr int width = 1;
using std::abs, std::asin, std::erf, std::exp, std::fma, std::log, std::log1p, std::max, std::min,
    std::sqrt, std::floor;
#include "common/models/shared_source.inc"
}  // namespace
}  // namespace f64

namespace {

Angles<f64::Wide> widen(const Angles<double>& a) {
  return {{a.n_dot_l},     {a.n_dot_v},     {a.n_dot_h},     {a.v_dot_h},     {a.r_dot_v},
          {a.n_l_versine}, {a.n_v_versine}, {a.n_h_versine}, {a.r_v_versine}, {a.azimuth},
          {a.tangent},     {a.bitangent},   {a.solid_angle}};
}

}  // namespace

Lobes<double> evaluate(const Reflection<double>& reflection, const Angles<double>& angles) {
  const auto lobes = f64::evaluate(reflection, widen(angles));
  return {lobes.diffuse[0], lobes.specular[0], lobes.white[0], lobes.fresnel[0],
          lobes.cosine[0],  lobes.height[0],   lobes.spread[0]};
}

double slope(Slope which, const Reflection<double>::Parameters& parameters,
             const Angles<double>& angles) {
  return f64::slope_value(which, parameters, widen(angles))[0];
}

double attenuation(Attenuation which, double roughness, const Angles<double>& angles) {
  return f64::attenuation_value(which, roughness, widen(angles))[0];
}

double diffuse(DiffuseTerm which, const Reflection<double>::Parameters& parameters,
               const Angles<double>& angles) {
  return f64::diffuse_value(which, parameters, widen(angles))[0];
}

double ripples(double height, double spread, double nm) {
  if (height < 0) return 1;
  const double k = 2000 * std::numbers::pi / nm;
  return f64::ripples_value({height}, {spread}, k * k)[0];
}

RoughMirror rough_mirror(const Reflection<double>::Parameters& parameters, double u) {
  const auto mirror = f64::he_torrance_mirror(u, 1 - u, f64::unpack<f64::HeTorrance>(parameters));
  return {mirror.masking, mirror.depth};
}

double schlick_fresnel(double u, double f) { return f64::schlick_fresnel(u, f); }
double dielectric_fresnel(double u, double n) { return f64::dielectric_fresnel(u, n); }
double conductor_fresnel(double u, double n, double k) { return f64::conductor_fresnel(u, n, k); }
double index_from_reflectance(double f) { return f64::index_from_reflectance(f); }

Angles<double> angles_between(const Eigen::Vector3d& normal, const Eigen::Vector3d& tangent,
                              const Eigen::Vector3d& to_light, const Eigen::Vector3d& to_viewer,
                              double solid_angle) {
  // As shaders/surface/angles.glsl has it.
  const auto cosine = [](double value) { return std::clamp(value, 0.0, 1.0); };
  const auto versine = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return std::min((a - b).squaredNorm() / 2, 1.0);
  };
  const Eigen::Vector3d apart = to_light - to_viewer;
  const double longer = apart.dot(to_light + to_viewer) / 4;
  const Eigen::Vector3d sum = to_light + to_viewer - longer * apart;
  const Eigen::Vector3d projected = sum - normal.dot(sum) * normal;
  const double size = sum.norm(), h = size > 0 ? normal.dot(sum) / size : 0;
  const double lifted = normal.dot(apart) - longer * normal.dot(sum);
  const double r_v_versine = std::min((projected.squaredNorm() + lifted * lifted) / 2, 1.0);
  const double j = normal.dot(to_light), k = normal.dot(to_viewer);
  const Eigen::Vector3d light = to_light - j * normal, viewer = to_viewer - k * normal;
  const double across = light.norm() * viewer.norm();
  const double t = projected.dot(tangent), b = projected.dot(normal.cross(tangent));
  const double whole = t * t + b * b;
  return {
      .n_dot_l = cosine(j),
      .n_dot_v = cosine(k),
      .n_dot_h = cosine(h),
      .v_dot_h = cosine(size / 2),
      .r_dot_v = 1 - r_v_versine,
      .n_l_versine = versine(normal, to_light),
      .n_v_versine = versine(normal, to_viewer),
      .n_h_versine = h > 0 ? std::min(projected.squaredNorm() / (size * size) / (1 + h), 1.0) : 1,
      .r_v_versine = r_v_versine,
      .azimuth = across > 0 ? std::clamp(light.dot(viewer) / across, -1.0, 1.0) : 0,
      .tangent = whole > 0 ? t * t / whole : 1,
      .bitangent = whole > 0 ? b * b / whole : 0,
      .solid_angle = solid_angle};
}

Reflection<double> default_reflection(Model model) {
  Reflection<double> reflection;
  reflection.model = model;
  reflection.parameters = {0.5, 0.5};
  const auto fill = [](std::span<const Parameter> parameters, double* to) {
    for (const Parameter& parameter : parameters) *to++ = parameter.default_value;
  };
  fill(entry(model).parameters, reflection.parameters.data() + 2);
  if (entry(model).traits & has_facets) {
    reflection.slopes[0] = {Slope::beckmann, 1, {}};
    fill(entry(Slope::beckmann).parameters, reflection.slopes[0].parameters.data());
    reflection.slope_count = 1;
    reflection.roughness = reflection.slopes[0].parameters[0];
  }
  return reflection;
}

}  // namespace metamer::models
