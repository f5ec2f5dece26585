#include "client/relight/scene_sources.h"

#include "common/spectral/cells.h"

namespace metamer::client {

Spectrum to_spectrum(const v1::SampledSpectrum& from) {
  return {{from.nm().begin(), from.nm().end()}, {from.values().begin(), from.values().end()}};
}

SceneSources::SceneSources(const v1::SceneFactors& scene) {
  for (const v1::SceneFactors::Material& from : scene.material()) {
    FactorSources::Material& material = factors_.materials.emplace_back();
    material.diffuse = &spectra_.emplace_back(to_spectrum(from.diffuse()));
    material.specular = &spectra_.emplace_back(to_spectrum(from.specular()));
    material.constants = nullptr;
    if (from.has_constants())
      material.constants = &constants_.emplace_back(
          OpticalConstants{to_spectrum(from.constants().n()), to_spectrum(from.constants().k())});
  }
}

std::vector<double> SceneSources::edges() const {
  std::vector<const Spectrum*> spectra;
  for (const Spectrum& spectrum : spectra_) spectra.push_back(&spectrum);
  for (const OpticalConstants& constants : constants_) {
    spectra.push_back(&constants.n);
    spectra.push_back(&constants.k);
  }
  return cell_edges(spectra);
}

}  // namespace metamer::client
