#include "tests/laws/random.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

namespace metamer::laws {
namespace {

using models::Entry, models::Kind;

double as_f32(double value) { return static_cast<float>(value); }

}  // namespace

double Random::between(double min, double max) { return min + (max - min) * uniform_(engine_); }

double Random::parameter(const models::Parameter& parameter) {
  // Take an end now and then.
  const auto [min, max] = std::pair(parameter.min, parameter.max);
  const double draw = uniform_(engine_);
  if (draw < 0.04) return draw < 0.02 ? min : max;
  if (min > 0 && max / min > 100) return min * std::pow(max / min, uniform_(engine_));
  return between(min, max);
}

models::Reflection<double>::Parameters Random::parameters(const Entry& entry) {
  models::Reflection<double>::Parameters result{};
  double* to = result.data();
  if (entry.kind == Kind::model) {
    *to++ = as_f32(uniform_(engine_));
    *to++ = as_f32(1 - result[0]);
  }
  for (const models::Parameter& one : entry.parameters) *to++ = parameter(one);
  return result;
}

const Entry& Random::one_of(Kind kind) {
  const auto entries = models::registry(kind);
  return entries[std::min(static_cast<std::size_t>(between(0, double(entries.size()))),
                          entries.size() - 1)];
}

models::Reflection<double> Random::reflection(const Entry& model) {
  models::Reflection<double> result;
  result.model = static_cast<models::Model>(model.index);
  result.parameters = parameters(model);
  if (uniform_(engine_) < 0.5) {
    const Entry& diffuse = one_of(Kind::diffuse);
    result.diffuse = static_cast<models::DiffuseTerm>(diffuse.index);
    result.diffuse_parameters = parameters(diffuse);
  }
  if (model.traits & models::has_facets) {
    const Entry& slope = one_of(Kind::slope);
    result.slopes[0] = {static_cast<models::Slope>(slope.index), 1, parameters(slope)};
    result.slope_count = 1;
    result.attenuation = static_cast<models::Attenuation>(one_of(Kind::attenuation).index);
    result.roughness = roughness_of(slope, result.slopes[0].parameters);
  }
  return rounded_to_f32(result);
}

Eigen::Vector3d Random::direction() {
  const double draw = uniform_(engine_), even = uniform_(engine_);
  const double small = std::pow(10, -8 * even);
  const double cosine = draw < 0.8 ? even : draw < 0.9 ? small : 1 - small;
  const double sine = std::sqrt((1 - cosine) * (1 + cosine));
  const double turn = between(0, 2 * std::numbers::pi);
  return {sine * std::cos(turn), sine * std::sin(turn), cosine};
}

Eigen::Vector3d Random::towards_mirror(const Eigen::Vector3d& to_light) {
  const Eigen::Vector3d other = direction();
  if (uniform_(engine_) < 0.4) return other;
  const Eigen::Vector3d mirrored(-to_light.x(), -to_light.y(), to_light.z());
  const Eigen::Vector3d near =
      (mirrored + std::pow(10, between(-6, 0)) * (other - mirrored)).normalized();
  return near.z() > 0 ? near : other;
}

double roughness_of(const Entry& slope, const models::Reflection<double>::Parameters& parameters) {
  double squares = 0, count = 0;
  for (std::size_t i = 0; i < slope.parameters.size(); ++i) {
    if (!std::string_view(slope.parameters[i].name).starts_with("roughness")) continue;
    squares += parameters[i] * parameters[i];
    ++count;
  }
  return std::sqrt(squares / count);
}

models::Reflection<double> rounded_to_f32(models::Reflection<double> reflection) {
  const auto round = [](auto& values) {
    std::transform(values.begin(), values.end(), values.begin(), as_f32);
  };
  round(reflection.parameters);
  round(reflection.diffuse_parameters);
  for (auto& slope : reflection.slopes) round(slope.parameters);
  reflection.roughness = as_f32(reflection.roughness);
  return reflection;
}

models::Angles<double> rounded_to_f32(models::Angles<double> a) {
  return {as_f32(a.n_dot_l),     as_f32(a.n_dot_v),     as_f32(a.n_dot_h),
          as_f32(a.v_dot_h),     as_f32(a.r_dot_v),     as_f32(a.n_l_versine),
          as_f32(a.n_v_versine), as_f32(a.n_h_versine), as_f32(a.r_v_versine),
          as_f32(a.azimuth),     as_f32(a.tangent),     as_f32(a.bitangent),
          as_f32(a.solid_angle)};
}

models::Angles<double> mirrored(models::Angles<double> angles) {
  angles.n_dot_h = angles.r_dot_v = 1;
  angles.n_h_versine = angles.r_v_versine = 0;
  return angles;
}

}  // namespace metamer::laws
