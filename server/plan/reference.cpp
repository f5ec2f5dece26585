#include "server/plan/reference.h"

#include <Eigen/Core>

#include "common/transport/fold.h"
#include "server/methods/direct_errors.h"
#include "server/transport/expand.h"
#include "server/transport/factor_rows.h"

namespace metamer {

Wavelengths Reference::cells(const RenderScene& scene, const Observer& observer) {
  std::vector<const Spectrum*> spectra = with_observer(observer, {});
  for (const Spectrum& emission : scene.emissions) spectra.push_back(&emission);
  for (const Spectrum& property : scene.properties) spectra.push_back(&property);
  for (const OpticalConstants& constants : scene.constants) {
    spectra.push_back(&constants.n);
    spectra.push_back(&constants.k);
  }
  return cells_of(spectra);
}

Reference::Reference(const RenderScene& scene, const Observer& observer)
    : Reference(scene, observer, cells(scene, observer)) {}

Reference::Reference(const RenderScene& scene, const Observer& observer,
                     const Wavelengths& wavelengths)
    : observer_(observer_weights(observer, wavelengths)),
      bands_(wavelengths.size()),
      factors_(factor_sources(scene), wavelengths.nm()) {
  bool has_white = false;
  for (const RenderLight& light : scene.lights) {
    Values power =
        resample(scene.emissions[light.emission], wavelengths.nm(), Outside::zero).values;
    const double scale = luminance_scale(observer_, power, light.luminance);
    for (double& value : power) value *= scale;
    if (!has_white && scale > 0) {
      white_ = usable_white(to_xyz(observer_, power));
      has_white = true;
    }
    lights_.push_back(std::move(power));
  }
}

/// Reflects each light at the end of a chain, and carries it back to the eye.
struct Reference::Fold : FoldHooks {
  Reference& reference;

  double* carrier(std::uint32_t chain) const {
    return reference.carriers_.data() + chain * reference.bands_;
  }

  void lobes(std::uint32_t chain, std::uint32_t material, std::span<const LobeWeights> weights) {
    lobes_as_terms(*this, chain, material, weights);
  }

  void term(std::uint32_t chain, std::uint32_t light, const FactorNode& factor, float weight) {
    const Values &power = reference.lights_[light], &values = reference.factors_(factor);
    double* to = carrier(chain);
    for (std::size_t i = 0; i < values.size(); ++i) to[i] += double{weight} * power[i] * values[i];
  }

  /// An exact Fresnel term lies on the line between two nodes, within 2e-5 (fresnel_table.h).
  void leave(std::uint32_t chain, std::uint32_t parent, const Factor& factor) {
    const FactorNodes<double> nodes = expand<double>(factor);
    const double* from = carrier(chain);
    double* to = carrier(parent);
    for (std::size_t j = 0; j < nodes.count; ++j) {
      const Values& values = reference.factors_(nodes.node[j]);
      for (std::size_t i = 0; i < values.size(); ++i)
        to[i] += nodes.weight[j] * from[i] * values[i];
    }
  }
};

Xyz Reference::resolve(const Gather& gather, double scale) {
  Xyz xyz{};
  if (gather.is_dark()) return xyz;
  carriers_.assign(gather.chains().size() * bands_, 0.0);
  fold(gather, Fold{{}, *this});
  using Row = Eigen::Map<const Eigen::VectorXd>;  // whose sums are made in lanes
  const auto size = static_cast<Eigen::Index>(bands_);
  for (std::size_t axis = 0; axis < 3; ++axis)
    xyz[axis] = scale * Row(carriers_.data(), size).dot(Row(observer_.weights[axis].data(), size));
  return xyz;
}

}  // namespace metamer
