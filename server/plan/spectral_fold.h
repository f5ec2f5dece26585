#pragma once

#include <span>
#include <vector>

#include "common/transport/factor_values.h"
#include "server/scene/render_scene.h"
#include "server/transport/gather.h"

namespace metamer {

/// What reaches the eye at some wavelengths, in f64: the sum over a gather's terms
/// (common/transport/fold.h). Belongs to one thread.
class SpectralFold {
 public:
  using Values = std::vector<double>;

  /// `lights`: the power of each of the scene's at `nm`. `scene`, of which is what is re-radiated
  /// of them, must outlive it.
  SpectralFold(const RenderScene& scene, std::vector<Values> lights, const Values& nm);

  /// The sums, by wavelength; they hold until the next call.
  std::span<const double> operator()(const Gather& gather);

  const std::vector<Values>& lights() const { return lights_; }
  const Values& factor(const FactorNode& factor) { return factors_(factor); }

 private:
  struct Walk;

  std::size_t bands_;
  const RenderScene& scene_;
  std::vector<Values> lights_;
  std::vector<Values> reradiated_;  ///< RenderScene::reradiated at the wavelengths.
  Values carriers_;                 ///< Of the pixel under way, chain by chain.
  FactorValues<double> factors_;
};

}  // namespace metamer
