#include "tests/laws/reflectance.h"

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "common/models/reference.h"
#include "tests/laws/random.h"

namespace metamer::laws {
namespace {

using models::Entry, models::Kind;
using std::numbers::pi;

// Facets by the logarithm of their slope, so that a lobe of any width gets as many.
constexpr int slopes = 400, turns = 288;
constexpr double smallest = 1e-7, largest = 1e4;

constexpr std::array incidences{0.0, 30.0, 60.0, 80.0, 89.0};  // Degrees.

/// One row of the table.
std::string row(const std::string& name, const std::string& parts,
                const models::Reflection<double>& reflection) {
  std::string text = "| " + name + " | " + parts + " |";
  for (const double degrees : incidences) {
    const double angle = degrees * pi / 180;
    std::array<char, 32> cell;
    std::snprintf(cell.data(), cell.size(), " %.3f |",
                  hemispherical_reflectance(reflection, {std::sin(angle), 0, std::cos(angle)}));
    text += cell.data();
  }
  return text + "\n";
}

std::string rows(const Entry& model) {
  auto reflection = models::default_reflection(static_cast<models::Model>(model.index));
  const char* promise = model.traits & models::conserving ? " (promises 1)" : "";
  const std::string name = model.name + std::string(promise);
  if (!(model.traits & models::weighted)) return row(name, "defaults", reflection);
  std::string text = row(name, "d = s = ½", reflection);
  reflection.parameters[0] = 0;
  reflection.parameters[1] = 1;
  if (!(model.traits & models::has_facets)) return text + row(name, "s = 1", reflection);

  // Every slope with every attenuation.
  for (const Entry& slope : models::registry(Kind::slope)) {
    auto& one = reflection.slopes[0];
    one.slope = static_cast<models::Slope>(slope.index);
    one.parameters = {};
    for (std::size_t i = 0; i < slope.parameters.size(); ++i)
      one.parameters[i] = slope.parameters[i].default_value;
    reflection.roughness = roughness_of(slope, one.parameters);
    for (const Entry& attenuation : models::registry(Kind::attenuation)) {
      reflection.attenuation = static_cast<models::Attenuation>(attenuation.index);
      text += row(name, std::string("s = 1, ") + slope.name + ", " + attenuation.name, reflection);
    }
  }
  return text;
}

/// A diffuse term by itself, where it reflects most and least.
std::string rows_of_diffuse(const Entry& term) {
  std::string text;
  for (const double roughness : {0.2, 1.0}) {
    auto reflection = models::default_reflection(models::Model::lambert);
    reflection.parameters[0] = 1;
    reflection.diffuse = static_cast<models::DiffuseTerm>(term.index);
    reflection.diffuse_parameters = {roughness};
    text +=
        row(term.name, roughness == 1 ? "d = 1, first parameter 1" : "d = 1, first parameter 0.2",
            reflection);
  }
  return text;
}

}  // namespace

double hemispherical_reflectance(const models::Reflection<double>& reflection,
                                 const Eigen::Vector3d& to_light) {
  const double step = std::log(largest / smallest) / slopes, turn = 2 * pi / turns;
  double sum = 0;
  for (int s = 0; s < slopes; ++s) {
    const double t = smallest * std::exp((s + 0.5) * step);
    const double cosine = 1 / std::sqrt(1 + t * t), sine = t * cosine;
    for (int i = 0; i < turns; ++i) {
      // Mirror the light at the facet.
      const double angle = (i + 0.5) * turn;
      const Eigen::Vector3d half(sine * std::cos(angle), sine * std::sin(angle), cosine);
      const double i_cosine = half.dot(to_light);
      if (i_cosine <= 0) continue;
      const Eigen::Vector3d to_viewer = 2 * i_cosine * half - to_light;
      if (to_viewer.z() <= 0) continue;

      // Add its share: dω of V is 4 (V·H) dω of H.
      const auto lobes = models::evaluate(
          reflection, models::angles_between(normal, tangent, to_light, to_viewer));
      const double rho =
          lobes.diffuse + lobes.specular + lobes.white + models::fresnel_weight(lobes);
      sum += rho * to_viewer.z() * 4 * i_cosine * sine * sine * cosine * step * turn;
    }
  }
  return sum / (pi * to_light.z());
}

std::string reflectance_table() {
  std::string text = "| model | with |";
  for (const double degrees : incidences) text += " " + std::to_string(int(degrees)) + "° |";
  text += "\n|---|---|";
  for (std::size_t i = 0; i < incidences.size(); ++i) text += "---|";
  text += "\n";
  for (const Entry& model : models::registry(Kind::model)) text += rows(model);
  for (const Entry& term : models::registry(Kind::diffuse)) text += rows_of_diffuse(term);
  return text;
}

}  // namespace metamer::laws
