#pragma once

#include <Eigen/Core>

#include "common/color/xyz.h"
#include "server/scene/render_scene.h"

/// The spectra of a scene as columns of matrices, a row a wavelength: what a method learns from
/// that is made for one scene.
namespace metamer {

Eigen::VectorXd to_vector(const std::vector<double>& values);
std::vector<double> to_list(const Eigen::VectorXd& vector);

/// Between which a product of the scene's surface spectra is a line (cell_edges).
std::vector<double> surface_edges(const RenderScene& scene);

/// The lights with their luminance, E[3.2-4], a column each.
Eigen::MatrixXd light_columns(const RenderScene& scene, const ObserverWeights& observer,
                              const Wavelengths& wavelengths);

/// The distinct emissions of lights of which the observer sees something, with luminance 1.
Eigen::MatrixXd unit_light_columns(const RenderScene& scene, const ObserverWeights& observer,
                                   const Wavelengths& wavelengths);

/// What fluorescences make of emissions, RenderScene::reradiated, a column each.
Eigen::MatrixXd reradiated_columns(const RenderScene& scene, const ObserverWeights& observer,
                                   const Wavelengths& wavelengths);

/// Of each pair of diffuse and fluorescence that some material has, all that comes of it under the
/// lights of unit_light_columns(): a column each for these.
std::vector<Eigen::MatrixXd> fluorescent_columns(const RenderScene& scene,
                                                 const ObserverWeights& observer,
                                                 const Wavelengths& wavelengths);

/// What a surface may multiply light by; of a Fresnel term, at three angles.
Eigen::MatrixXd surface_columns(const RenderScene& scene, const Wavelengths& wavelengths);

/// Of light that surfaces have reflected more often there is little.
inline constexpr std::uint32_t most_bounces = 4;

/// The same of mirrors alone, of what light goes through, and of surfaces that light others.
Eigen::MatrixXd mirror_columns(const RenderScene& scene, const Wavelengths& wavelengths);

}  // namespace metamer
