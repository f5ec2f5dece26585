#pragma once

#include <list>
#include <vector>

#include "common/transport/factor_sources.h"
#include "metamer/v1/factors.pb.h"

namespace metamer::client {

Spectrum to_spectrum(const v1::SampledSpectrum& from);

/// What the factors of a file's scene are made of.
class SceneSources {
 public:
  /// The scene is sound (scene_fault).
  explicit SceneSources(const v1::SceneFactors& scene);
  SceneSources(SceneSources&&) = default;

  /// Points into this.
  const FactorSources& factors() const { return factors_; }

 private:
  std::list<Spectrum> spectra_;
  std::list<OpticalConstants> constants_;
  std::vector<Fluorescence> fluorescences_;
  FactorSources factors_;
};

}  // namespace metamer::client
