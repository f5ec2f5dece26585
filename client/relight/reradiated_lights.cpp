#include "client/relight/reradiated_lights.h"

#include <algorithm>
#include <cmath>

#include "client/relight/scene_sources.h"
#include "common/color/xyz.h"

namespace metamer::client {
namespace {

bool is_rising(const google::protobuf::RepeatedField<double>& nm) {
  return nm.size() >= 2 && nm[0] > 0 && std::isfinite(nm[nm.size() - 1]) &&
         std::adjacent_find(nm.begin(), nm.end(), [](double a, double b) { return !(b > a); }) ==
             nm.end();
}

/// Its samples are sound, and at least two.
bool is_curve(const v1::SampledSpectrum& spectrum) {
  return spectrum.nm_size() >= 2 &&
         make_spectrum({spectrum.nm().begin(), spectrum.nm().end()},
                       {spectrum.values().begin(), spectrum.values().end()})
             .has_value() &&
         std::all_of(spectrum.values().begin(), spectrum.values().end(),
                     [](double value) { return value >= 0; });
}

}  // namespace

std::string fluorescence_fault(const v1::SampledFluorescence& own) {
  if (own.has_excitation() || own.has_emission()) {
    const auto& emission = own.emission().values();
    const bool shines =
        std::any_of(emission.begin(), emission.end(), [](double value) { return value > 0; });
    return is_curve(own.excitation()) && is_curve(own.emission()) && shines &&
                   own.quantum_yield() >= 0 && own.quantum_yield() <= 1
               ? ""
               : "a fluorescence has no sound spectra";
  }
  const auto cells = static_cast<std::size_t>(own.excitation_nm_size()) *
                     static_cast<std::size_t>(own.emission_nm_size());
  const bool sound = is_rising(own.excitation_nm()) && is_rising(own.emission_nm()) &&
                     cells <= max_bispectral_cells &&
                     cells == static_cast<std::size_t>(own.matrix_size()) &&
                     std::all_of(own.matrix().begin(), own.matrix().end(),
                                 [](float value) { return value >= 0 && std::isfinite(value); });
  return sound ? "" : "a fluorescence has no sound matrix";
}

Fluorescence to_fluorescence(const v1::SampledFluorescence& from) {
  if (from.has_emission())
    return Fluorophore{to_spectrum(from.excitation()), to_spectrum(from.emission()),
                       from.quantum_yield()};
  return BispectralMatrix{{from.excitation_nm().begin(), from.excitation_nm().end()},
                          {from.emission_nm().begin(), from.emission_nm().end()},
                          {from.matrix().begin(), from.matrix().end()}};
}

std::string energy_fault(const v1::SceneFactors& scene) {
  for (const auto& material : scene.material()) {
    if (!material.has_fluorescence()) continue;
    const auto index = static_cast<int>(material.fluorescence());
    const auto fault = metamer::energy_fault(to_fluorescence(scene.fluorescence(index)),
                                             to_spectrum(material.diffuse()));
    if (fault) return "of \"" + material.name() + "\" " + *fault;
  }
  return {};
}

ReradiatedLights::ReradiatedLights(const v1::TileFactors& tables, const v1::SceneFactors& scene,
                                   const Observer& observer) {
  for (int i = 0; i < tables.signature_term_size(); ++i) {
    if (tables.signature_term(i) != v1::FACTOR_RERADIATE) continue;
    const std::uint32_t light = tables.signature_light(i), material = tables.signature_material(i);
    if (!known_.try_emplace({light, material}, all_.size()).second) continue;
    const auto& source = scene.light(static_cast<int>(light));
    const auto index = scene.material(static_cast<int>(material)).fluorescence();
    const Spectrum power = to_spectrum(source.power());
    const double y = emission_xyz(power, observer)[1];
    Light& one = all_.emplace_back(
        Light{reradiated(to_fluorescence(scene.fluorescence(static_cast<int>(index))), power), 0});
    for (double& value : one.power.values) value *= y > 0 ? source.luminance() / y : 0;
    one.luminance = emission_xyz(one.power, observer)[1];
  }
}

std::optional<std::size_t> ReradiatedLights::of(std::uint32_t light,
                                                const FactorNode& factor) const {
  if (factor.kind != FactorKind::reradiate) return std::nullopt;
  return known_.at({light, factor.index});
}

}  // namespace metamer::client
