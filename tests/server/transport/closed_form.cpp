#include "tests/server/transport/closed_form.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/models/reference.h"
#include "common/scene/fresnel_table.h"
#include "common/transport/factor_kinds.h"
#include "server/scene/bundles.h"
#include "server/transport/factor_rows.h"
#include "tests/server/test_scene.h"

namespace metamer::test {
namespace {

template <class Kind>
std::uint32_t any_index(const FactorSources& sources, std::mt19937& random) {
  for (;;) {
    const auto index = static_cast<std::uint32_t>(random() % Kind::count(sources));
    if (Kind::source(sources, index) != nullptr) return index;
  }
}

float unit(std::mt19937& random) { return std::uniform_real_distribution<float>(0, 1)(random); }

Factor any_factor(const FactorSources& sources, std::mt19937& random) {
  // What a mirror may be: never a diffuse spectrum or a lobe, nor what stands in a light's place.
  FactorKind kind = FactorKind::diffuse;
  while (kind == FactorKind::diffuse || kind == FactorKind::lobe || kind == FactorKind::reradiate)
    kind = factor_entries[random() % factor_kind_count].kind;
  return with_kind(kind, [&]<class Kind>(Kind) -> Factor {
    // The ends of the range, too.
    const float at = random() % 8 == 0 ? static_cast<float>(random() % 2) : unit(random);
    return {kind, any_index<Kind>(sources, random), at};
  });
}

/// A chain of 0 to 8 factors, as a rule one that branches off another.
std::uint32_t any_chain(Gather& gather, const FactorSources& sources, std::mt19937& random) {
  auto chain = static_cast<std::uint32_t>(random() % gather.chains().size());
  std::size_t length = 0, wanted = random() % 9;
  for (std::uint32_t at = chain; at != 0; at = gather.chains()[at].parent) ++length;
  for (; length > wanted; --length) chain = gather.chains()[chain].parent;
  for (; length < wanted; ++length) chain = gather.chain(chain, any_factor(sources, random));
  return chain;
}

Spectra fresnel_values(std::uint32_t node, const Spectra& n, const Spectra& k) {
  const double cosine = std::pow(double(node) / 511, 2);
  Spectra values;
  for (std::size_t i = 0; i < n.size(); ++i)
    values.push_back(models::conductor_fresnel(cosine, n[i], k[i]));
  return values;
}

Spectra index_of(const RenderScene& scene, std::uint32_t medium, const Spectra& nm) {
  if (medium == 0) return Spectra(nm.size(), 1.0);
  const std::uint32_t material = scene.media[medium].material;
  return resample(scene.constants[scene.materials[material].constants].n, nm, Outside::hold).values;
}

/// Where 1 − exp(−s/2) has grown by i steps of 1/160, and above s = 2 by steps of the same slope in
/// ln s.
double absorption_length(std::uint32_t i) {
  const double turn = 160 * (1 - std::exp(-1));
  return i <= turn ? -2 * std::log(1 - i / 160.0) : 2 * std::exp((i - turn) * std::exp(1) / 160);
}

}  // namespace

RenderScene transport_scene() {
  return compile_text(R"(
    camera { eye { z: 3 } target {} }
    light { name: "a" position { y: 2 } spectrum { standard: "F11" } luminance: 0.8 }
    light { name: "b" position { y: 1 } spectrum { standard: "A" } luminance: 0.3 }
    light { name: "c" position { y: 1 } spectrum { standard: "D65" } luminance: 0.1 }
    material {
      name: "paint" mirror: 0.5 diffuseness: 0.6 specularness: 0.4 blinn_phong {}
      diffuse { samples { wavelength: [400, 500, 600, 700] value: [0.1, 0.7, 0.2, 0.5] } }
      specular { samples { wavelength: [400, 700] value: [0.9, 0.3] } }
    }
    material { name: "gold" mirror: 1 fresnel { conductor { metal: "Au" } } }
    material { name: "copper" mirror: 1 fresnel { conductor { metal: "Cu" } } }
    material {
      name: "lacquer" mirror: 1 fresnel { schlick {} }
      specular { samples { wavelength: [400, 550, 700] value: [0.2, 0.9, 0.4] } }
    }
    material {
      name: "glass" fresnel { dielectric { medium: "N-BK7" } }
      transmission {
        transmittance { samples { wavelength: [400, 500, 700] value: [0.2, 0.9, 0.6] } } thickness: 2
      }
    }
    material { name: "rough" mirror: 1 fresnel { conductor { metal: "Ag" } } he_torrance {} }
    material { name: "satin" specular { samples { wavelength: [400, 700] value: [0.5, 0.7] } } he_torrance {} }
    material { name: "water" fresnel { dielectric { medium: "water" } } transmission { dispersion: true } }
    object { name: "o" material: "paint" sphere { radius: 1 } }
    object { name: "p" material: "glass" sphere { radius: 1 } }
    object { name: "q" material: "water" sphere { radius: 0.5 } }
    settings { height: 1 })");
}

Gather random_gather(const RenderScene& scene, std::mt19937& random) {
  const FactorSources sources = factor_sources(scene);
  const auto lights = static_cast<std::uint32_t>(scene.lights.size());
  Gather gather(scene.lights.size());
  for (std::size_t i = random() % 7; i > 0; --i) {
    const std::uint32_t chain = any_chain(gather, sources, random);
    const auto surface =
        gather.surface(chain, static_cast<std::uint32_t>(random() % scene.materials.size()));
    for (std::uint32_t light = 0; light < lights; ++light)
      gather.weights(surface, light) = {unit(random), random() % 2 ? 0 : unit(random),
                                        random() % 2 ? 0 : unit(random)};
  }
  for (const FactorEntry& entry : factor_entries) {
    if (entry.kind == FactorKind::reradiate) continue;  // fluorescence_test.cpp
    for (std::size_t i = random() % 7; i > 0; --i)
      with_kind(entry.kind, [&]<class Kind>(Kind) {
        const std::uint32_t chain = any_chain(gather, sources, random);
        gather.add(chain, static_cast<std::uint32_t>(random() % lights),
                   {entry.kind, any_index<Kind>(sources, random),
                    static_cast<std::uint32_t>(random() % Kind::Table::nodes)},
                   unit(random));
      });
  }
  return gather;
}

Spectra values_of(const RenderScene& scene, const FactorNode& factor, const Spectra& nm) {
  const auto property = [&](std::uint32_t index) {
    return resample(scene.properties[index], nm, Outside::hold).values;
  };
  switch (factor.kind) {
    case FactorKind::white:
    case FactorKind::reradiate:  // a light in the place of a light
      return Spectra(nm.size(), 1.0);
    case FactorKind::diffuse:
      return property(scene.materials[factor.index].diffuse);
    case FactorKind::specular:
      return property(scene.materials[factor.index].specular);
    case FactorKind::fresnel: {
      const OpticalConstants& own = scene.constants[scene.materials[factor.index].constants];
      const Spectra n = resample(own.n, nm, Outside::hold).values;
      const Spectra k =
          own.k.nm.empty() ? Spectra(nm.size(), 0.0) : resample(own.k, nm, Outside::hold).values;
      return fresnel_values(factor.node, n, k);
    }
    case FactorKind::reflect:
    case FactorKind::transmit: {
      const RenderInterface& one = scene.interfaces[factor.index];
      Spectra n = index_of(scene, one.dense, nm), values;
      const Spectra rare = index_of(scene, one.rare, nm);
      for (std::size_t i = 0; i < nm.size(); ++i) n[i] /= rare[i];
      values = fresnel_values(factor.node, n, Spectra(nm.size(), 0.0));
      if (factor.kind == FactorKind::transmit)
        for (double& value : values) value = 1 - value;
      return values;
    }
    case FactorKind::window: {
      // A hat from the middle before to the one behind.
      const auto& windows = scene.windows;
      const auto middle = [&](std::size_t i) { return middle_of(windows[i]); };
      const std::size_t b = factor.index;
      Spectra values;
      for (const double at : nm) {
        double value = 1;
        if (at < middle(b) && b > 0) value = (at - middle(b - 1)) / (middle(b) - middle(b - 1));
        if (at > middle(b) && b + 1 < windows.size())
          value = (middle(b + 1) - at) / (middle(b + 1) - middle(b));
        values.push_back(std::max(value, 0.0));
      }
      return values;
    }
    case FactorKind::lobe: {
      // Chebyshev's nodes are orthogonal: Lagrange's polynomial is a sum of products of T_n.
      const RenderMaterial& own = scene.materials[factor.index];
      const double u = std::pow((factor.node / 8) / 127.0, 2), turn = factor.node % 8 + 0.5;
      Spectra values;
      if (own.fresnel == FresnelKind::exact) {
        const OpticalConstants& constants = scene.constants[own.constants];
        const Spectra n = resample(constants.n, nm, Outside::hold).values,
                      k = resample(constants.k, nm, Outside::hold).values;
        for (std::size_t i = 0; i < nm.size(); ++i)
          values.push_back(models::conductor_fresnel(u, n[i], k[i]));
      } else {
        for (const double f : property(own.specular))
          values.push_back(f + (1 - f) * std::pow(1 - u, 5));
      }
      for (std::size_t i = 0; i < nm.size(); ++i) {
        const double angle = std::acos(std::clamp((560 - nm[i]) / 170, -1.0, 1.0));
        double window = 1.0 / 8;
        for (int n = 1; n < 8; ++n)
          window += std::cos(n * turn * std::numbers::pi / 8) * std::cos(n * angle) / 4;
        values[i] *= window;
      }
      return values;
    }
    case FactorKind::coherent: {
      Spectra values;
      for (const double at : nm)
        values.push_back(
            std::exp(-std::pow(4 * std::numbers::pi * 330 * factor.node / 511 / at, 2)));
      return values;
    }
    case FactorKind::absorb: {
      // Of the glass: T^(s/S) where S = −ln 0.2.
      Spectra values = property(scene.media[scene.materials[factor.index].medium].transmittance);
      for (double& value : values)
        value = std::pow(value, absorption_length(factor.node) / -std::log(0.2));
      return values;
    }
  }
  return {};
}

std::vector<std::pair<FactorNode, double>> nodes_of(const Factor& factor) {
  const auto node = [&](std::uint32_t which) {
    return FactorNode{factor.kind, factor.index, which};
  };
  const double u = factor.at;
  switch (factor.kind) {
    case FactorKind::white:
    case FactorKind::diffuse:
    case FactorKind::window:
    case FactorKind::lobe:
    case FactorKind::reradiate:
      return {{node(0), 1}};
    case FactorKind::coherent: {
      const double at = std::min(u / 0.33 * 511, 511.0);
      const auto below = static_cast<std::uint32_t>(std::min(std::floor(at), 510.0));
      return {{node(below), 1 - (at - below)}, {node(below + 1), at - below}};
    }
    case FactorKind::specular:
      return {{node(0), 1 - std::pow(1 - u, 5)}, {{FactorKind::white, 0, 0}, std::pow(1 - u, 5)}};
    case FactorKind::absorb: {
      std::uint32_t below = 0;
      while (below < 1022 && absorption_length(below + 1) <= u) ++below;
      const double low = absorption_length(below), high = absorption_length(below + 1);
      return {{node(below), (high - u) / (high - low)},
              {node(below + 1), (u - low) / (high - low)}};
    }
    case FactorKind::reflect:
    case FactorKind::transmit:
    case FactorKind::fresnel: {
      const auto below =
          static_cast<std::uint32_t>(std::min(std::floor(std::sqrt(u) * 511), 510.0));
      const double low = std::pow(below / 511.0, 2), high = std::pow((below + 1) / 511.0, 2);
      const double share = (u - low) / (high - low);
      return {{node(below), 1 - share}, {node(below + 1), share}};
    }
  }
  return {};
}

std::vector<Way> ways(const Gather& gather) {
  std::vector<Way> all;
  const auto add = [&](double weight, std::uint32_t chain, std::uint32_t light,
                       const FactorNode& last) {
    Way way{weight, light, last, {}};
    for (; chain != 0; chain = gather.chains()[chain].parent)
      way.chain.insert(way.chain.begin(), gather.chains()[chain].factor);
    all.push_back(std::move(way));
  };
  for (std::size_t s = 0; s < gather.surfaces().size(); ++s) {
    const auto [chain, material] = gather.surfaces()[s];
    for (std::uint32_t light = 0; light < gather.weights(s).size(); ++light) {
      const LobeWeights& w = gather.weights(s)[light];
      add(w.diffuse, chain, light, {FactorKind::diffuse, material, 0});
      add(w.specular, chain, light, {FactorKind::specular, material, 0});
      add(w.white, chain, light, {FactorKind::white, 0, 0});
    }
  }
  for (const Gather::Term& one : gather.terms()) add(one.weight, one.chain, one.light, one.factor);
  return all;
}

}  // namespace metamer::test
