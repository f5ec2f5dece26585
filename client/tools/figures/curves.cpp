#include "client/tools/figures/curves.h"

#include <algorithm>
#include <cmath>

#include "common/models/reference.h"

namespace metamer::client {
namespace {

constexpr double step = 0.5;  ///< Degrees between the samples of a curve.

/// The angles in the plane of incidence, the surface's tangent in it or across it.
models::Angles<double> angles_at(double incidence, double viewer, bool tangent_across) {
  const double l = radians(-incidence), v = radians(viewer);
  const Eigen::Vector3d tangent =
      tangent_across ? Eigen::Vector3d::UnitY() : Eigen::Vector3d::UnitX();
  return models::angles_between(Eigen::Vector3d::UnitZ(), tangent, {std::sin(l), 0, std::cos(l)},
                                {std::sin(v), 0, std::cos(v)});
}

/// Samples a function of degrees.
template <class Function>
Curve sampled(const std::string& label, double from, double to, Function function) {
  Curve curve;
  curve.label = label;
  const auto count = static_cast<int>(std::lround((to - from) / step));
  for (int i = 0; i <= count; ++i) {
    curve.angle.push_back(from + i * step);
    curve.value.push_back(function(curve.angle.back()));
  }
  return curve;
}

}  // namespace

Curve brdf_curve(const std::string& label, const models::Reflection<double>& reflection, double f,
                 double incidence, bool tangent_across) {
  Curve curve = sampled(label, -90, 90, [&](double viewer) {
    const auto lobes = models::evaluate(reflection, angles_at(incidence, viewer, tangent_across));
    return lobes.diffuse + lobes.specular + lobes.white +
           models::fresnel_weight(lobes) * models::schlick_fresnel(lobes.cosine, f);
  });
  curve.incidence = incidence;
  return curve;
}

Curve diffuse_curve(const std::string& label, models::DiffuseTerm term,
                    const models::Reflection<double>::Parameters& parameters, double incidence) {
  Curve curve = sampled(label, -90, 90, [&](double viewer) {
    return models::diffuse(term, parameters, angles_at(incidence, viewer, false));
  });
  curve.incidence = incidence;
  return curve;
}

Curve slope_curve(const std::string& label, models::Slope slope,
                  const models::Reflection<double>::Parameters& parameters, bool across) {
  return sampled(label, -90, 90, [&](double angle) {
    // The bisector is where the light and the viewer both are.
    return models::slope(slope, parameters, angles_at(-angle, angle, across));
  });
}

Curve relative_to_peak(Curve curve) {
  const double peak = *std::max_element(curve.value.begin(), curve.value.end());
  for (double& value : curve.value) value /= peak;
  return curve;
}

Curve attenuation_curve(const std::string& label, models::Attenuation attenuation, double roughness,
                        double incidence) {
  return sampled(label, -90, 90, [&](double viewer) {
    const auto angles = angles_at(incidence, viewer, false);
    return angles.n_dot_v * models::attenuation(attenuation, roughness, angles);
  });
}

Curve fresnel_curve(const std::string& label, const models::FresnelForm& form,
                    std::vector<double> parameters) {
  return sampled(label, 0, 90, [&](double angle) {
    return form.value(std::cos(radians(angle)), parameters.data());
  });
}

std::string incidence_label(double incidence) { return "θ = " + number_text(incidence) + "°"; }

std::string value_label(const char* symbol, double value) {
  return std::string(symbol) + " = " + number_text(value);
}

}  // namespace metamer::client
