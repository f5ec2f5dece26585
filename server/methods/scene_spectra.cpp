#include "server/methods/scene_spectra.h"

#include <cmath>
#include <numbers>
#include <set>

#include "common/models/reference.h"
#include "common/scene/fresnel_table.h"
#include "common/scene/rough_lobe_table.h"
#include "common/scene/rough_mirror_table.h"

namespace metamer {
namespace {

Eigen::MatrixXd to_matrix(const std::vector<Eigen::VectorXd>& columns, Eigen::Index rows) {
  Eigen::MatrixXd matrix(rows, static_cast<Eigen::Index>(columns.size()));
  for (std::size_t i = 0; i < columns.size(); ++i)
    matrix.col(static_cast<Eigen::Index>(i)) = columns[i];
  return matrix;
}

void add(const OpticalConstants& constants, const Wavelengths& wavelengths,
         std::vector<Eigen::VectorXd>& columns) {
  const ConstantsAt at = resample(constants, wavelengths.nm());
  for (const double cosine : {1.0, 0.4, 0.1}) columns.push_back(to_vector(fresnel_at(at, cosine)));
}

void add(const Spectrum& property, const Wavelengths& wavelengths,
         std::vector<Eigen::VectorXd>& columns) {
  columns.push_back(to_vector(resample(property, wavelengths.nm(), Outside::hold).values));
}

/// The Fresnel term at right angles, or C_S.
std::vector<double> reflected(const RenderScene& scene, const RenderMaterial& material,
                              const std::vector<double>& nm) {
  if (material.fresnel == FresnelKind::exact)
    return fresnel_at(resample(scene.constants[material.constants], nm), 1);
  return resample(scene.properties[material.specular], nm, Outside::hold).values;
}

/// Of a rough lobe, in the mirrored direction and where half, and nearly all, of its light is gone.
void add_lobes(const RenderScene& scene, const RenderMaterial& material,
               const Wavelengths& wavelengths, std::vector<Eigen::VectorXd>& columns) {
  const Eigen::VectorXd fresnel = to_vector(reflected(scene, material, wavelengths.nm()));
  const double height = 4 * std::pow(double{material.reflection.parameters[2]}, 2);
  for (const double depth : {0.0, 0.7, 4.0}) {
    // Terms fade with s/g where there are many, with s where there is one.
    const double k2 = std::pow(2 * std::numbers::pi / 0.55, 2);
    const double spread = depth * std::max(height * k2, 1.0) / k2;
    std::vector<double> values;
    for (const double nm : wavelengths.nm())
      values.push_back(models::ripples(height, spread, nm) / models::ripples(height, spread, 550));
    columns.push_back(fresnel.cwiseProduct(to_vector(values)));
  }
}

/// Of a rough mirror, at some depths.
void add_rough_mirrors(const RenderScene& scene, const RenderMaterial& material,
                       const Wavelengths& wavelengths, std::vector<Eigen::VectorXd>& columns) {
  const Eigen::VectorXd fresnel = to_vector(reflected(scene, material, wavelengths.nm()));
  for (const double depth : {0.036, 0.07})
    columns.push_back(fresnel.cwiseProduct(to_vector(rough_mirror(depth, wavelengths.nm()))));
}

}  // namespace

Eigen::VectorXd to_vector(const std::vector<double>& values) {
  return Eigen::Map<const Eigen::VectorXd>(values.data(), static_cast<Eigen::Index>(values.size()));
}

std::vector<double> to_list(const Eigen::VectorXd& vector) {
  return {vector.data(), vector.data() + vector.size()};
}

std::vector<double> surface_edges(const RenderScene& scene) {
  std::vector<const Spectrum*> spectra;
  for (const Spectrum& property : scene.properties) spectra.push_back(&property);
  for (const OpticalConstants& constants : scene.constants) {
    spectra.push_back(&constants.n);
    spectra.push_back(&constants.k);
  }
  for (const Spectrum& window : scene.windows) spectra.push_back(&window);
  for (const RenderMaterial& material : scene.materials)
    if (material.has(models::diffracting)) spectra.push_back(&lobe_grid());
  return cell_edges(spectra);
}

Eigen::MatrixXd light_columns(const RenderScene& scene, const ObserverWeights& observer,
                              const Wavelengths& wavelengths) {
  std::vector<Eigen::VectorXd> columns;
  for (const RenderLight& light : scene.lights) {
    const auto power = mean_power(scene.emissions[light.emission], wavelengths);
    columns.push_back(luminance_scale(observer, power, light.luminance) * to_vector(power));
  }
  return to_matrix(columns, static_cast<Eigen::Index>(wavelengths.size()));
}

Eigen::MatrixXd reradiated_columns(const RenderScene& scene, const ObserverWeights& observer,
                                   const Wavelengths& wavelengths) {
  std::vector<Eigen::VectorXd> columns;
  for (const RenderScene::Reradiated& one : scene.reradiated) {
    const auto power = mean_power(one.power, wavelengths);
    columns.push_back(luminance_scale(observer, power, one.luminance) * to_vector(power));
  }
  return to_matrix(columns, static_cast<Eigen::Index>(wavelengths.size()));
}

std::vector<Eigen::MatrixXd> fluorescent_columns(const RenderScene& scene,
                                                 const ObserverWeights& observer,
                                                 const Wavelengths& wavelengths) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (const RenderMaterial& material : scene.materials)
    if (material.fluorescence) pairs.insert({material.diffuse, *material.fluorescence});
  std::vector<Eigen::MatrixXd> blocks;
  if (pairs.empty()) return blocks;
  const Eigen::MatrixXd emitted = reradiated_columns(scene, observer, wavelengths);
  for (const auto& [diffuse, fluorescence] : pairs) {
    const Eigen::VectorXd surface =
        to_vector(resample(scene.properties[diffuse], wavelengths.nm(), Outside::hold).values);
    std::vector<Eigen::VectorXd> columns;
    for (std::size_t e = 0; e < scene.emissions.size(); ++e) {
      const auto power = mean_power(scene.emissions[e], wavelengths);
      const double scale = luminance_scale(observer, power, 1);
      if (!(scale > 0)) continue;
      const std::size_t own = e * scene.fluorescences.size() + fluorescence;
      columns.push_back(scale * to_vector(power).cwiseProduct(surface) +
                        emitted.col(static_cast<Eigen::Index>(own)));
    }
    blocks.push_back(to_matrix(columns, static_cast<Eigen::Index>(wavelengths.size())));
  }
  return blocks;
}

Eigen::MatrixXd unit_light_columns(const RenderScene& scene, const ObserverWeights& observer,
                                   const Wavelengths& wavelengths) {
  std::vector<Eigen::VectorXd> columns;
  for (const Spectrum& emission : scene.emissions) {
    const auto power = mean_power(emission, wavelengths);
    const double scale = luminance_scale(observer, power, 1);
    if (scale > 0) columns.push_back(scale * to_vector(power));
  }
  return to_matrix(columns, static_cast<Eigen::Index>(wavelengths.size()));
}

Eigen::MatrixXd surface_columns(const RenderScene& scene, const Wavelengths& wavelengths) {
  std::vector<Eigen::VectorXd> columns;
  for (const Spectrum& property : scene.properties) add(property, wavelengths, columns);
  for (const OpticalConstants& constants : scene.constants) add(constants, wavelengths, columns);
  for (const RenderMaterial& material : scene.materials)
    if (material.has(models::diffracting)) add_lobes(scene, material, wavelengths, columns);
  return to_matrix(columns, static_cast<Eigen::Index>(wavelengths.size()));
}

Eigen::MatrixXd mirror_columns(const RenderScene& scene, const Wavelengths& wavelengths) {
  std::set<std::uint32_t> properties, constants, diffuse;
  for (const RenderMaterial& material : scene.materials) {
    if (scene.bounces > 0) diffuse.insert(material.diffuse);
    if (absorbs(scene, material)) properties.insert(scene.media[material.medium].transmittance);
    if (!(material.mirror > 0)) continue;
    if (material.fresnel == FresnelKind::exact)
      constants.insert(material.constants);
    else
      properties.insert(material.specular);
  }
  std::vector<Eigen::VectorXd> columns;
  for (const std::uint32_t i : properties) add(scene.properties[i], wavelengths, columns);
  for (const std::uint32_t i : diffuse) {
    add(scene.properties[i], wavelengths, columns);
    const Eigen::ArrayXd once = columns.back().array();
    for (std::uint32_t times = 2; times <= std::min(scene.bounces, most_bounces); times *= 2)
      columns.push_back(once.pow(times));
  }
  for (const std::uint32_t i : constants) add(scene.constants[i], wavelengths, columns);
  for (const RenderMaterial& material : scene.materials)
    if (material.mirror > 0 && material.has(models::diffracting))
      add_rough_mirrors(scene, material, wavelengths, columns);
  for (const Spectrum& window : scene.windows) add(window, wavelengths, columns);
  return to_matrix(columns, static_cast<Eigen::Index>(wavelengths.size()));
}

}  // namespace metamer
