#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/spectral/cie.h"
#include "common/spectral/fluorescence.h"
#include "common/transport/factor.h"
#include "metamer/v1/factors.pb.h"

namespace metamer::client {

/// What is wrong with a fluorescence of a file; empty: it is sound.
std::string fluorescence_fault(const v1::SampledFluorescence& fluorescence);
/// The message is sound.
Fluorescence to_fluorescence(const v1::SampledFluorescence& from);

/// Why a material of a sound scene, with the spectra that it has now, sends out more light than
/// comes: energy_fault() with its name. Empty: none does.
std::string energy_fault(const v1::SceneFactors& scene);

/// The lights that a scene's fluorescences make of its own: what stands in the place of a light
/// where a term's factor is FACTOR_RERADIATE.
class ReradiatedLights {
 public:
  /// Of those that the signatures of `tables` name.
  ReradiatedLights(const v1::TileFactors& tables, const v1::SceneFactors& scene,
                   const Observer& observer);

  struct Light {
    Spectrum power;
    double luminance;
  };
  const std::vector<Light>& all() const { return all_; }
  /// Which of all() a light and a factor of a signature are; nothing: that factor re-radiates
  /// nothing.
  std::optional<std::size_t> of(std::uint32_t light, const FactorNode& factor) const;

 private:
  std::vector<Light> all_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> known_;  ///< By light, material.
};

}  // namespace metamer::client
