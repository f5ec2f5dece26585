#include "client/relight/rgb_colors.h"

#include <algorithm>
#include <map>

#include "client/relight/reradiated_lights.h"
#include "client/relight/scene_sources.h"
#include "common/color/rgb_of_spectra.h"
#include "common/color/srgb.h"
#include "common/spectral/cells.h"
#include "common/transport/factor_values.h"
#include "common/transport/fold.h"
#include "common/transport/message_tables.h"

namespace metamer::client {
namespace {

Rgb product(const Rgb& a, const Rgb& b) { return {a[0] * b[0], a[1] * b[1], a[2] * b[2]}; }

/// Where the scene's surfaces have a corner.
std::vector<double> corners_of(const FactorSources& sources) {
  std::vector<const Spectrum*> spectra;
  for (const FactorSources::Material& material : sources.materials) {
    spectra.push_back(material.diffuse);
    spectra.push_back(material.specular);
    if (material.transmittance != nullptr) spectra.push_back(material.transmittance);
    if (material.constants == nullptr) continue;
    spectra.push_back(&material.constants->n);
    if (!material.constants->k.nm.empty()) spectra.push_back(&material.constants->k);
  }
  for (const OpticalConstants* interface : sources.interfaces) spectra.push_back(&interface->n);
  spectra.insert(spectra.end(), sources.windows.begin(), sources.windows.end());
  return cell_edges(spectra);
}

/// The colours of the chains, and of the terms at their ends.
class RgbFold : public FoldHooks {
 public:
  RgbFold(const v1::TileFactors& tables, const v1::SceneFactors& scene, const Observer& observer)
      : sources_(scene),
        reradiated_(tables, scene, observer),
        nm_(corners_of(sources_.factors())),
        values_(sources_.factors(), nm_),
        surface_(observer, nm_),
        chains_{Rgb{1, 1, 1}} {
    for (const auto& light : scene.light())
      lights_.push_back(light_rgb(observer, to_spectrum(light.power()), light.luminance()));
    for (const ReradiatedLights::Light& light : reradiated_.all())
      reradiated_rgb_.push_back(light_rgb(observer, light.power, light.luminance));
  }

  void enter(std::uint32_t, std::uint32_t parent, const FactorNode& factor) {
    chains_.push_back(product(chains_[parent], color(factor)));
  }

  void term(std::uint32_t chain, std::uint32_t light, const FactorNode& factor, float) {
    const auto own = reradiated_.of(light, factor);
    const Rgb& from = own ? reradiated_rgb_[*own] : lights_[light];
    const Xyz xyz = srgb::to_xyz(product(product(chains_[chain], from), color(factor)));
    Color& to = colors_.emplace_back();
    std::transform(xyz.begin(), xyz.end(), to.value,
                   [](double value) { return static_cast<float>(value); });
  }

  std::vector<Color> take() { return std::move(colors_); }

 private:
  const Rgb& color(const FactorNode& factor) {
    const auto [entry, is_new] = known_.try_emplace(factor);
    if (is_new) entry->second = surface_(values_(factor));
    return entry->second;
  }

  SceneSources sources_;
  ReradiatedLights reradiated_;
  std::vector<double> nm_;
  FactorValues<double> values_;
  SurfaceRgb surface_;
  std::vector<Rgb> lights_, reradiated_rgb_, chains_;
  std::map<FactorNode, Rgb> known_;
  std::vector<Color> colors_;
};

}  // namespace

std::vector<Color> rgb_colors(const v1::TileFactors& tables, const v1::SceneFactors& scene,
                              const Observer& observer) {
  RgbFold carrier(tables, scene, observer);
  fold(MessageTerms(tables), carrier);
  return carrier.take();
}

}  // namespace metamer::client
