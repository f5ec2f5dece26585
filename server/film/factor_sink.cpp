#include "server/film/factor_sink.h"

#include <algorithm>

#include "common/transport/fold.h"
#include "server/transport/expand.h"

namespace metamer {
namespace {

void set_spectrum(const Spectrum& spectrum, v1::SampledSpectrum& to) {
  to.mutable_nm()->Assign(spectrum.nm.begin(), spectrum.nm.end());
  to.mutable_values()->Assign(spectrum.values.begin(), spectrum.values.end());
}

void set_constants(const OpticalConstants& constants, v1::SampledConstants& to) {
  set_spectrum(constants.n, *to.mutable_n());
  if (!constants.k.nm.empty()) set_spectrum(constants.k, *to.mutable_k());
}

void set_fluorescence(const Fluorescence& from, v1::SampledFluorescence& to) {
  if (const auto* molecules = std::get_if<Fluorophore>(&from)) {
    set_spectrum(molecules->excitation, *to.mutable_excitation());
    set_spectrum(molecules->emission, *to.mutable_emission());
    to.set_quantum_yield(molecules->quantum_yield);
    return;
  }
  const auto& matrix = std::get<BispectralMatrix>(from);
  to.mutable_excitation_nm()->Assign(matrix.excitation.begin(), matrix.excitation.end());
  to.mutable_emission_nm()->Assign(matrix.emission.begin(), matrix.emission.end());
  for (const double value : matrix.values) to.add_matrix(static_cast<float>(value));
}

}  // namespace

FactorSink::FactorSink(PixelSink& next, std::uint32_t spp)
    : next_(next), scale_(1 / static_cast<float>(spp)) {}

void FactorSink::begin(const Rect& tile) {
  tile_ = tile;
  tables_.clear();
  sums_.clear();
  pixels_.assign(std::size_t{tile.width} * tile.height, {});
}

/// The parts of a chain: those of its parent, each times the one or two nodes of its last factor.
std::vector<FactorSink::Part> FactorSink::longer(const std::vector<Part>& parent,
                                                 const Factor& factor) {
  const FactorNodes<float> nodes = expand<float>(factor);
  std::vector<Part> parts;
  const auto add_part = [&](std::uint32_t product, float weight) {
    for (Part& part : parts)
      if (part.product == product) {
        part.weight += weight;
        return;
      }
    if (weight != 0) parts.push_back({product, weight});
  };
  for (const Part& part : parent)
    for (std::size_t j = 0; j < nodes.count; ++j)
      add_part(nodes.node[j].kind == FactorKind::white
                   ? part.product
                   : tables_.product(part.product, nodes.node[j]),
               part.weight * nodes.weight[j]);
  if (parts.size() > max_parts) {
    overflowed_ = true;
    parts.clear();
  }
  return parts;
}

void FactorSink::add(std::uint32_t signature, float weight) {
  sums_.resize(tables_.signatures());
  if (sums_[signature] == 0) touched_.push_back(signature);
  sums_[signature] += weight;
}

/// Names the products of each chain, and sums the weights of their signatures.
struct FactorSink::Fold : FoldHooks {
  FactorSink& sink;
  std::vector<std::vector<Part>> parts;  ///< Of each chain.

  void enter(std::uint32_t, std::uint32_t parent, const Factor& factor) {
    parts.push_back(sink.longer(parts[parent], factor));
  }

  void lobes(std::uint32_t chain, std::uint32_t material, std::span<const LobeWeights> weights) {
    lobes_as_terms(*this, chain, material, weights);
  }

  void term(std::uint32_t chain, std::uint32_t light, const FactorNode& factor, float weight) {
    if (weight == 0) return;
    for (const Part& part : parts[chain])
      sink.add(sink.tables_.signature(part.product, light, factor),
               sink.scale_ * weight * part.weight);
  }
};

void FactorSink::take(std::uint32_t x, std::uint32_t y, const Gather& gather) {
  next_.take(x, y, gather);
  if (overflowed_) return;
  fold(gather, Fold{{}, *this, {{{0, 1.0f}}}});

  auto& pixel = pixels_[std::size_t{y - tile_.y} * tile_.width + (x - tile_.x)];
  for (const std::uint32_t signature : touched_) {
    if (sums_[signature] != 0) pixel.push_back({signature, sums_[signature]});
    sums_[signature] = 0;
  }
  touched_.clear();
}

v1::TileFactors FactorSink::finish() {
  if (overflowed_) return {};
  v1::TileFactors& message = tables_.message();
  for (const std::vector<Pair>& pixel : pixels_) {
    message.add_count(static_cast<std::uint32_t>(pixel.size()));
    for (const Pair& pair : pixel) {
      message.add_signature(pair.signature);
      message.add_weight(pair.weight);
    }
  }
  return std::move(message);
}

v1::SceneFactors scene_factors(const RenderScene& scene) {
  v1::SceneFactors factors;
  for (const Spectrum& function : scene.observer.functions())
    set_spectrum(function, *factors.add_observer());
  for (const RenderLight& light : scene.lights) {
    v1::SceneFactors::Light& to = *factors.add_light();
    to.set_name(light.name);
    to.set_luminance(light.luminance);
    set_spectrum(scene.emissions[light.emission], *to.mutable_power());
  }
  for (const RenderMaterial& material : scene.materials) {
    v1::SceneFactors::Material& to = *factors.add_material();
    to.set_name(material.name);
    set_spectrum(scene.properties[material.diffuse], *to.mutable_diffuse());
    set_spectrum(scene.properties[material.specular], *to.mutable_specular());
    to.set_rough(material.has(models::diffracting));
    if (material.fluorescence) to.set_fluorescence(*material.fluorescence);
    if (absorbs(scene, material))
      set_spectrum(scene.properties[scene.media[material.medium].transmittance],
                   *to.mutable_transmittance());
    if (material.fresnel == FresnelKind::exact)
      set_constants(scene.constants[material.constants], *to.mutable_constants());
  }
  for (const RenderInterface& interface : scene.interfaces)
    set_constants(scene.constants[interface.constants], *factors.add_interface());
  for (const Spectrum& window : scene.windows) set_spectrum(window, *factors.add_window());
  for (const Fluorescence& fluorescence : scene.fluorescences)
    set_fluorescence(fluorescence, *factors.add_fluorescence());
  return factors;
}

}  // namespace metamer
