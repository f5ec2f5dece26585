#include "client/relight/scene_sources.h"

#include "client/relight/reradiated_lights.h"

namespace metamer::client {

Spectrum to_spectrum(const v1::SampledSpectrum& from) {
  return {{from.nm().begin(), from.nm().end()}, {from.values().begin(), from.values().end()}};
}

SceneSources::SceneSources(const v1::SceneFactors& scene) {
  for (const auto& fluorescence : scene.fluorescence())
    fluorescences_.push_back(to_fluorescence(fluorescence));
  for (const v1::SceneFactors::Material& from : scene.material()) {
    FactorSources::Material& material = factors_.materials.emplace_back();
    material.diffuse = &spectra_.emplace_back(to_spectrum(from.diffuse()));
    material.specular = &spectra_.emplace_back(to_spectrum(from.specular()));
    material.constants = nullptr;
    material.is_rough = from.rough();
    if (from.has_fluorescence()) material.fluorescence = &fluorescences_[from.fluorescence()];
    if (from.has_constants())
      material.constants = &constants_.emplace_back(
          OpticalConstants{to_spectrum(from.constants().n()), to_spectrum(from.constants().k())});
    if (from.has_transmittance())
      material.transmittance = &spectra_.emplace_back(to_spectrum(from.transmittance()));
  }
  for (const v1::SampledSpectrum& from : scene.window())
    factors_.windows.push_back(&spectra_.emplace_back(to_spectrum(from)));
  for (const v1::SampledConstants& from : scene.interface())
    factors_.interfaces.push_back(
        &constants_.emplace_back(OpticalConstants{to_spectrum(from.n()), {}}));
}

}  // namespace metamer::client
