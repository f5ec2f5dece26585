#include "tests/extremes/builds.h"

#include <algorithm>
#include <cfloat>
#include <cmath>

#include "common/models/reference.h"
#include "server/cpu/shared_source.h"
#include "server/models/lanes.h"

namespace metamer::extremes {
namespace {

/// Of a lobe's peak: where the lobe is less, an error from vectors is told beside this.
constexpr double negligible = 1e-6;

template <class Number>
Number fresnel(const Row& row) {
  const auto u = static_cast<Number>(row.inputs[0]);
  const auto p = [&](std::size_t i) { return static_cast<Number>(row.parameters[i]); };
  if (row.form == "schlick_fresnel") return models::schlick_fresnel(u, p(0));
  if (row.form == "dielectric_fresnel") return models::dielectric_fresnel(u, p(0));
  if (row.form == "conductor_fresnel") return models::conductor_fresnel(u, p(0), p(1));
  return models::index_from_reflectance(u);  // Its f stands in place of u.
}

/// One of the three kinds that give one number.
template <class Angle, class Parameters>
auto part_value(const Row& row, const Parameters& parameters, const Angle& angles) {
  if (row.kind == "slopes") {
    const int index = index_of(models::Kind::slope, row.form);
    return models::slope(static_cast<models::Slope>(index), parameters, angles);
  }
  if (row.kind == "attenuations") {
    const int index = index_of(models::Kind::attenuation, row.form);
    return models::attenuation(static_cast<models::Attenuation>(index), parameters[0], angles);
  }
  const int index = index_of(models::Kind::diffuse, row.form);
  return models::diffuse(static_cast<models::DiffuseTerm>(index), parameters, angles);
}

std::vector<double> evaluate_f64(const Row& row) {
  if (row.kind == "fresnel") return {fresnel<double>(row)};
  if (row.kind == "ripples")
    return {models::ripples(row.inputs[0], row.inputs[1], row.parameters[0])};
  if (row.kind != "models") return {part_value(row, parameters(row.parameters), angles(row))};
  auto lobes = models::evaluate(reflection(row), angles(row));
  if (row.from_vectors) lobes.fresnel = models::fresnel_weight(lobes, 550);
  return {lobes.diffuse, lobes.specular, lobes.white, lobes.fresnel,
          lobes.cosine,  lobes.height,   lobes.spread};
}

models::Angles<Floats> lanes(const Row& row) {
  const auto lane = [](double value) { return broadcast(static_cast<float>(value)); };
  if (row.from_vectors) {
    const auto vector = [&](std::size_t i) {
      return Vectors{lane(row.inputs[i]), lane(row.inputs[i + 1]), lane(row.inputs[i + 2])};
    };
    return cpu::shared::angles_of(vector(0), vector(3), vector(6), vector(9), lane(row.inputs[12]),
                                  true, true);
  }
  const auto a = angles(row);
  return {lane(a.n_dot_l),     lane(a.n_dot_v),     lane(a.n_dot_h),     lane(a.v_dot_h),
          lane(a.r_dot_v),     lane(a.n_l_versine), lane(a.n_v_versine), lane(a.n_h_versine),
          lane(a.r_v_versine), lane(a.azimuth),     lane(a.tangent),     lane(a.bitangent),
          lane(a.solid_angle)};
}

std::vector<double> evaluate_f32(const Row& row) {
  if (!row.single) return {};
  if (row.kind == "fresnel") return {fresnel<float>(row)};
  if (row.kind == "ripples") {
    const auto lane = [](double value) { return broadcast(static_cast<float>(value)); };
    return {models::ripples(lane(row.inputs[0]), lane(row.inputs[1]),
                            static_cast<float>(row.parameters[0]))[0]};
  }
  if (row.kind != "models")
    return {part_value(row, single(parameters(row.parameters)), lanes(row))[0]};
  auto lobes = models::evaluate(single(reflection(row)), lanes(row));
  if (row.from_vectors && lobes.height[0] >= 0)
    lobes.fresnel *= models::ripples(lobes.height, lobes.spread, 550);
  return {lobes.diffuse[0], lobes.specular[0], lobes.white[0], lobes.fresnel[0],
          lobes.cosine[0],  lobes.height[0],   lobes.spread[0]};
}

template <class Evaluate>
Values each(const std::vector<Row>& rows, Evaluate evaluate) {
  Values values;
  for (const Row& row : rows) values.push_back(evaluate(row));
  return values;
}

Error compare(double truth, double value, double peak, const Bound& bound) {
  const double size = std::abs(truth);
  if (size > bound.largest) return {0, value > 0.99 * bound.largest};
  const double difference = std::abs(value - truth);
  if (size < bound.smallest && difference < bound.smallest) return {};
  const double relative = difference / size;
  const double of_peak = peak > 0 ? difference / peak : relative;
  const bool within = relative <= bound.relative || of_peak <= bound.of_peak;
  // A bound that is 0 is none; of two, the error is told that is the smaller. What is so small that
  // only its share of the peak counts has no relative error.
  if (bound.of_peak == 0) return {relative, within};
  if (bound.of_peak <= negligible * bound.relative)
    return {difference / std::max(size, negligible * peak), within};
  if (bound.relative == 0) return {of_peak, within};
  return {std::min(relative, of_peak), within};
}

}  // namespace

Bound bound(Build build, const Row& row) {
  // Sums that end where a term counts for little (shaders/models/ripples.glsl).
  if (row.kind == "ripples") {
    if (build == Build::f64) return {"f64", 1e-5, 1e-30, DBL_MIN, DBL_MAX};
    return {build == Build::f32 ? "f32" : "GLSL", 1e-3, 1e-3 * negligible, FLT_MIN, FLT_MAX};
  }
  const bool from_vectors = row.from_vectors;
  if (from_vectors && build == Build::f64 && row.form == "he_torrance")
    return {"f64", 1e-5, 1e-5 * negligible, DBL_MIN, DBL_MAX};
  switch (build) {
    case Build::f64:
      if (from_vectors) return {"f64", 1e-9, 1e-9 * negligible, DBL_MIN, DBL_MAX};
      return {"f64", 1e-12, 0, DBL_MIN, DBL_MAX};
    case Build::f32:
      if (from_vectors) return {"f32", 1e-3, 1e-3 * negligible, FLT_MIN, FLT_MAX};
      return {"f32", 2e-6, 5e-7, FLT_MIN, FLT_MAX};
    case Build::glsl:
      if (from_vectors) return {"GLSL", 1e-3, 1e-3 * negligible, FLT_MIN, FLT_MAX};
      return {"GLSL", 0, 2e-4, FLT_MIN, FLT_MAX};
  }
  return {};
}

Values evaluate_f64(const std::vector<Row>& rows) {
  return each(rows, [](const Row& row) { return evaluate_f64(row); });
}

Values evaluate_f32(const std::vector<Row>& rows) {
  return each(rows, [](const Row& row) { return evaluate_f32(row); });
}

Error compare(const Row& row, const std::vector<double>& values, const Bound& bound) {
  Error worst;
  for (std::size_t i = 0; i < std::min(values.size(), row.values.size()); ++i) {
    // Behind a model's cosine come lengths, which are no part of its highlight.
    const double peak = row.kind == "models" && i > 4 ? 0 : row.peak;
    Error error = compare(row.values[i], values[i], peak, bound);
    if (std::isnan(values[i])) error = {HUGE_VAL, false};
    worst = {std::max(worst.size, error.size), worst.within && error.within};
  }
  return worst;
}

}  // namespace metamer::extremes
