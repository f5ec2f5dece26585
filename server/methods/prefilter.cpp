#include "server/methods/prefilter.h"

#include <Eigen/LU>

#include "common/color/srgb.h"
#include "server/methods/banded.h"
#include "server/methods/scene_spectra.h"

namespace metamer {
namespace {

/// A component of the dominant light is too small to divide by below this share of the largest:
/// in RGB, where it may also be negative, and in XYZ, where rounding alone is left.
constexpr double least_rgb = 0.01, least_xyz = 1e-6;

/// What the three values are.
struct Filter {
  const RenderLight* dominant = nullptr;  ///< None where the observer sees no light.
  bool rgb = true;                        ///< Or X Y Z.
  Eigen::Matrix3d to_values;              ///< From X Y Z.
  Eigen::Vector3d white;                  ///< The dominant light with luminance 1, in the values.
  Eigen::MatrixXd surface;  ///< A column for each value: what it weighs a reflectance by; sums 1.
};

Eigen::Matrix3d rgb_from_xyz() {
  Eigen::Matrix3d matrix;
  for (std::size_t i = 0; i < 9; ++i)
    matrix(static_cast<Eigen::Index>(i / 3), static_cast<Eigen::Index>(i % 3)) =
        srgb::from_xyz_matrix()[i / 3][i % 3];
  return matrix;
}

/// An observer as a matrix, a column each of X, Y and Z.
Eigen::MatrixXd to_columns(const ObserverWeights& observer) {
  Eigen::MatrixXd matrix(static_cast<Eigen::Index>(observer.weights[0].size()), 3);
  for (std::size_t axis = 0; axis < 3; ++axis)
    matrix.col(static_cast<Eigen::Index>(axis)) = to_vector(observer.weights[axis]);
  return matrix;
}

/// `nm`: between which surfaces are lines.
Filter make_filter(const RenderScene& scene, const Observer& observer,
                   const std::vector<double>& nm) {
  // The dominant light is the first (4.6.1) of which anything is seen; without any, equal energy.
  Filter filter;
  const Eigen::MatrixXd equal = to_columns(under_light(observer, *cie::illuminant("E"), nm));
  Eigen::MatrixXd lit = equal;
  for (const RenderLight& light : scene.lights) {
    const ObserverWeights own = under_light(observer, scene.emissions[light.own_emission], nm);
    if (!(to_columns(own).col(1).sum() > 0)) continue;
    filter.dominant = &light;
    lit = to_columns(own);
    break;
  }

  // Take RGB where the light has enough of each of the three, else XYZ.
  const Eigen::Vector3d white = lit.colwise().sum();
  filter.to_values = rgb_from_xyz();
  filter.white = filter.to_values * white;
  filter.rgb = filter.white.minCoeff() > least_rgb * filter.white.maxCoeff();
  if (!filter.rgb) {
    filter.to_values.setIdentity();
    filter.white = white;
  }

  // Where the light has none of a value, a surface is what it is under equal energy.
  filter.surface = lit * filter.to_values.transpose();
  for (Eigen::Index i = 0; i < 3; ++i) {
    if (!(filter.white[i] > least_xyz * filter.white.maxCoeff())) {
      filter.white[i] = 1;
      filter.surface.col(i) = equal * filter.to_values.row(i).transpose();
    }
    // An observer may see nothing of it anywhere.
    const double all = filter.surface.col(i).sum();
    if (all != 0) filter.surface.col(i) /= all;
  }
  return filter;
}

}  // namespace

std::unique_ptr<Method> make_prefilter(const v1::Plan&, const RenderScene& scene) {
  const Observer& observer = scene.observer;
  const std::vector<double> nm = surface_edges(scene);
  const Filter filter = make_filter(scene, observer, nm);

  LightTables lights(scene, 3, [&](const Spectrum& emission, double luminance) {
    const Xyz xyz = white_of(emission, observer);
    const Eigen::Vector3d values =
        filter.to_values * (luminance * Eigen::Vector3d(xyz[0], xyz[1], xyz[2]));
    return to_list(values.cwiseQuotient(filter.white));
  });

  FactorRows rows(scene);
  BandTable values(rows.size(), 3);
  rows.for_each(scene, nm, [&](std::uint32_t row, const std::vector<double>& at) {
    values.set(row, to_list(filter.surface.transpose() * to_vector(at)));
  });

  BandTable xyz(3, 3);
  const Eigen::Matrix3d to_xyz = filter.to_values.inverse() * filter.white.asDiagonal();
  for (std::size_t i = 0; i < 3; ++i)
    xyz.set(i, to_list(to_xyz.row(static_cast<Eigen::Index>(i)).transpose()));
  return std::make_unique<BandedMethod>(
      std::move(rows), BandedMethod::Tables{std::move(lights), std::move(values), std::move(xyz)});
}

void plan_prefilter(const RenderScene& scene, const v1::Settings&, v1::Plan& plan) {
  const Filter filter = make_filter(scene, scene.observer, surface_edges(scene));
  const auto say = [&](const std::string& message) {
    v1::Notice* notice = plan.add_notice();
    notice->set_field("settings.method.prefilter");
    notice->set_message(message);
  };
  if (filter.dominant == nullptr) return;  // each light's own notice says that it stays dark
  const std::string name = "light \"" + filter.dominant->name + "\"";
  if (filter.dominant != &scene.lights.front())
    say(name + " is the dominant one: nothing is seen of those before it");
  if (!filter.rgb)
    say(name + " has too little red, green or blue to divide by: X, Y and Z are filtered instead");
}

}  // namespace metamer
