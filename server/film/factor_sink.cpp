#include "server/film/factor_sink.h"

#include <algorithm>

#include "common/scene/fresnel_table.h"
#include "server/models/lanes.h"

namespace metamer {
namespace {

void set_spectrum(const Spectrum& spectrum, v1::SampledSpectrum& to) {
  to.mutable_nm()->Assign(spectrum.nm.begin(), spectrum.nm.end());
  to.mutable_values()->Assign(spectrum.values.begin(), spectrum.values.end());
}

}  // namespace

FactorSink::FactorSink(const RenderScene& scene, PixelSink& next, std::uint32_t spp)
    : scene_(scene), next_(next), scale_(1 / static_cast<float>(spp)) {}

void FactorSink::begin(const Rect& tile) {
  tile_ = tile;
  tables_.Clear();
  products_.clear();
  signatures_.clear();
  sums_.clear();
  pixels_.assign(std::size_t{tile.width} * tile.height, {});
}

std::uint32_t FactorSink::product(std::uint32_t parent, const Factor& factor) {
  const auto next = static_cast<std::uint32_t>(products_.size() + 1);
  const auto [place, is_new] = products_.try_emplace({parent, factor}, next);
  if (is_new) {
    tables_.add_product_parent(parent);
    tables_.add_product_material(std::get<0>(factor));
    tables_.add_product_term(std::get<1>(factor));
    tables_.add_product_node(std::get<2>(factor));
  }
  return place->second;
}

std::uint32_t FactorSink::signature(std::uint32_t product, std::uint32_t light,
                                    const Factor& factor) {
  const auto next = static_cast<std::uint32_t>(signatures_.size());
  const auto [place, is_new] = signatures_.try_emplace({product, light, factor}, next);
  if (is_new) {
    tables_.add_signature_product(product);
    tables_.add_signature_light(light);
    tables_.add_signature_material(std::get<0>(factor));
    tables_.add_signature_term(std::get<1>(factor));
    tables_.add_signature_node(std::get<2>(factor));
    sums_.push_back(0);
  }
  return place->second;
}

/// The terms of a path: those of its parent, each times the one or two of its last mirror.
std::vector<FactorSink::Term> FactorSink::mirrored(const std::vector<Term>& parent,
                                                   const Gather::Path& path) {
  std::vector<Term> terms;
  const auto add_term = [&](std::uint32_t product, float weight) {
    for (Term& term : terms)
      if (term.product == product) {
        term.weight += weight;
        return;
      }
    if (weight != 0) terms.push_back({product, weight});
  };
  const RenderMaterial& material = scene_.materials[path.material];
  for (const Term& term : parent) {
    switch (material.fresnel) {
      case FresnelKind::none:
        add_term(product(term.product, {path.material, v1::FACTOR_SPECULAR, 0}), term.weight);
        break;
      case FresnelKind::schlick: {
        const float rise = models::schlick_rise(path.cosine);
        add_term(product(term.product, {path.material, v1::FACTOR_SPECULAR, 0}),
                 term.weight * (1 - rise));
        add_term(term.product, term.weight * rise);
        break;
      }
      case FresnelKind::exact: {
        const FresnelPlace place = fresnel_place(path.cosine);
        add_term(product(term.product, {path.material, v1::FACTOR_FRESNEL, place.below}),
                 term.weight * (1 - place.fraction));
        add_term(product(term.product, {path.material, v1::FACTOR_FRESNEL, place.below + 1}),
                 term.weight * place.fraction);
        break;
      }
    }
  }
  if (terms.size() > max_terms) {
    overflowed_ = true;
    terms.clear();
  }
  return terms;
}

void FactorSink::add(std::uint32_t signature, float weight) {
  if (sums_[signature] == 0) touched_.push_back(signature);
  sums_[signature] += weight;
}

void FactorSink::add_all(const std::vector<Term>& terms, std::uint32_t light, const Factor& factor,
                         float weight) {
  if (weight == 0) return;
  for (const Term& term : terms)
    add(signature(term.product, light, factor), scale_ * weight * term.weight);
}

void FactorSink::take(std::uint32_t x, std::uint32_t y, const Gather& gather) {
  next_.take(x, y, gather);
  if (overflowed_) return;

  // A path comes after its parent.
  std::vector<std::vector<Term>> terms{{{0, 1.0f}}};
  for (std::size_t path = 1; path < gather.paths().size(); ++path)
    terms.push_back(mirrored(terms[gather.paths()[path].parent], gather.paths()[path]));

  const auto surfaces = gather.surfaces();
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    const std::uint32_t material = surfaces[s].material;
    const auto weights = gather.weights(s);
    for (std::uint32_t light = 0; light < weights.size(); ++light) {
      const LobeWeights& w = weights[light];
      const auto& path = terms[surfaces[s].path];
      add_all(path, light, {material, v1::FACTOR_DIFFUSE, 0}, w.diffuse);
      add_all(path, light, {material, v1::FACTOR_SPECULAR, 0}, w.specular);
      add_all(path, light, {0, v1::FACTOR_WHITE, 0}, w.white);
    }
  }
  for (const Gather::FresnelWeight& one : gather.fresnel()) {
    const Gather::Surface& surface = surfaces[one.surface];
    add_all(terms[surface.path], one.light, {surface.material, v1::FACTOR_FRESNEL, one.node},
            one.weight);
  }

  auto& pixel = pixels_[std::size_t{y - tile_.y} * tile_.width + (x - tile_.x)];
  for (const std::uint32_t signature : touched_) {
    if (sums_[signature] != 0) pixel.push_back({signature, sums_[signature]});
    sums_[signature] = 0;
  }
  touched_.clear();
}

v1::TileFactors FactorSink::finish() {
  if (overflowed_) return {};
  for (const std::vector<Pair>& pixel : pixels_) {
    tables_.add_count(static_cast<std::uint32_t>(pixel.size()));
    for (const Pair& pair : pixel) {
      tables_.add_signature(pair.signature);
      tables_.add_weight(pair.weight);
    }
  }
  return std::move(tables_);
}

v1::SceneFactors scene_factors(const RenderScene& scene) {
  v1::SceneFactors factors;
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
    if (material.fresnel != FresnelKind::exact) continue;
    const OpticalConstants& constants = scene.constants[material.constants];
    set_spectrum(constants.n, *to.mutable_constants()->mutable_n());
    if (!constants.k.nm.empty()) set_spectrum(constants.k, *to.mutable_constants()->mutable_k());
  }
  return factors;
}

}  // namespace metamer
