#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "common/transport/factor.h"

namespace metamer {

/// The weights of a light's reflection, summed over the samples of a pixel: see lobes.glsl.
struct LobeWeights {
  float diffuse = 0, specular = 0, white = 0;
};

/// What a pixel receives, before any spectrum: a sum of terms weight · light · factor · factor · …
/// Everything that does not depend on wavelength has been multiplied and summed into weights, so
/// spectral work is done once for each distinct combination in the pixel instead of once for each
/// sample. The same combination is never stored twice. fold() (common/transport/fold.h) walks over
/// it.
///
/// A chain is the sequence of factors between eye and surface; chain 0 goes straight from the eye.
/// The factor of the surface itself is the term's own: what it makes of a light is what methods
/// tabulate. Most terms are the three lobes of a surface, which are kept as a block for all lights.
class Gather {
 public:
  /// `reradiates`: of the scene's materials (reradiating()); empty: none does.
  explicit Gather(std::size_t lights, std::vector<bool> reradiates = {})
      : lights_(lights), reradiates_(std::move(reradiates)) {
    clear();
  }

  struct Chain {
    std::uint32_t parent;  ///< The chain without its last factor; lower than its own index.
    Factor factor;         ///< The last; of chain 0 none.
    bool before = false;   ///< Light has met some of it before it met the surface.
  };
  /// Where a material is seen along a chain.
  struct Surface {
    std::uint32_t chain, material;
  };
  struct Term {
    FactorNode factor;
    std::uint32_t chain, light;
    float weight;
  };

  void clear() {
    chains_.assign(1, {0, {FactorKind::white, 0, 0}});
    links_.assign(1, {});
    surfaces_.clear();
    next_surface_.clear();
    weights_.clear();
    terms_.clear();
  }

  /// Nothing has been received.
  bool is_dark() const { return surfaces_.empty() && terms_.empty(); }

  /// The chain that continues `parent` by `factor`.
  std::uint32_t chain(std::uint32_t parent, const Factor& factor) {
    return chain(parent, factor, false);
  }
  /// The same by what light meets before it meets the surface. Products commute, so that it may
  /// stand behind the surface, too; but for what is re-radiated, which is left out there.
  std::uint32_t chain_before(std::uint32_t parent, const Factor& factor) {
    return chain(parent, factor, true);
  }

  /// The surface of `material` seen along `chain`.
  std::uint32_t surface(std::uint32_t chain, std::uint32_t material) {
    for (std::uint32_t i = links_[chain].surface; i != none; i = next_surface_[i])
      if (surfaces_[i].material == material) return i;
    const auto made = static_cast<std::uint32_t>(surfaces_.size());
    surfaces_.push_back({chain, material});
    next_surface_.push_back(links_[chain].surface);
    links_[chain].surface = made;
    weights_.resize(weights_.size() + lights_);
    return made;
  }

  /// The weights of a surface's diffuse, specular and white factors under one light.
  LobeWeights& weights(std::uint32_t surface, std::size_t light) {
    return weights_[surface * lights_ + light];
  }

  /// Adds to the weight of any other factor.
  void add(std::uint32_t chain, std::uint32_t light, const FactorNode& factor, float weight) {
    // The samples of a pixel are much alike: look at the newest first.
    for (std::size_t i = terms_.size(); i-- > 0;) {
      Term& one = terms_[i];
      if (one.factor.node == factor.node && one.light == light && one.chain == chain &&
          one.factor == factor) {
        one.weight += weight;
        return;
      }
    }
    terms_.push_back({factor, chain, light, weight});
  }

  std::span<const Chain> chains() const { return chains_; }
  std::span<const Surface> surfaces() const { return surfaces_; }
  std::span<const Term> terms() const { return terms_; }
  /// One for each light.
  std::span<const LobeWeights> weights(std::size_t surface) const {
    return std::span(weights_).subspan(surface * lights_, lights_);
  }

  /// For fold(): the lobes of each surface by carrier.lobes(chain, material, weights by light), and
  /// as terms what it re-radiates, which spreads as its diffuse lobe; then the other terms.
  template <class Carrier>
  void for_each_term(Carrier& carrier) const {
    for (std::size_t s = 0; s < surfaces_.size(); ++s) {
      const auto [chain, material] = surfaces_[s];
      carrier.lobes(chain, material, weights(s));
      if (reradiates_.empty() || !reradiates_[material] || chains_[chain].before) continue;
      for (std::uint32_t light = 0; light < lights_; ++light)
        if (const float weight = weights(s)[light].diffuse; weight != 0)
          carrier.term(chain, light, FactorNode{FactorKind::reradiate, material, 0}, weight);
    }
    for (const Term& one : terms_) carrier.term(one.chain, one.light, one.factor, one.weight);
  }

 private:
  std::uint32_t chain(std::uint32_t parent, const Factor& factor, bool before) {
    before = before || chains_[parent].before;
    for (std::uint32_t i = links_[parent].child; i != none; i = links_[i].sibling)
      if (chains_[i].factor == factor && chains_[i].before == before) return i;
    const auto made = static_cast<std::uint32_t>(chains_.size());
    chains_.push_back({parent, factor, before});
    links_.push_back({none, links_[parent].child, none});
    links_[parent].child = made;
    return made;
  }

  static constexpr std::uint32_t none = 0xffffffff;
  /// Of a chain: the newest that continue it and the newest surface at its end; each knows the next
  /// one. A pixel whose surfaces light each other has thousands of chains.
  struct Link {
    std::uint32_t child = none, sibling = none, surface = none;
  };

  std::size_t lights_;
  std::vector<bool> reradiates_;  ///< By material.
  std::vector<Chain> chains_;
  std::vector<Link> links_;  ///< By chain.
  std::vector<Surface> surfaces_;
  std::vector<std::uint32_t> next_surface_;  ///< Of the same chain, by surface.
  std::vector<LobeWeights> weights_;
  std::vector<Term> terms_;
};

/// A surface's lobes as terms, where a carrier has no faster way for the three together.
template <class Carrier>
void lobes_as_terms(Carrier& carrier, std::uint32_t chain, std::uint32_t material,
                    std::span<const LobeWeights> weights) {
  for (std::uint32_t light = 0; light < weights.size(); ++light) {
    const LobeWeights& w = weights[light];
    if (w.diffuse != 0)
      carrier.term(chain, light, FactorNode{FactorKind::diffuse, material, 0}, w.diffuse);
    if (w.specular != 0)
      carrier.term(chain, light, FactorNode{FactorKind::specular, material, 0}, w.specular);
    if (w.white != 0) carrier.term(chain, light, FactorNode{FactorKind::white, 0, 0}, w.white);
  }
}

}  // namespace metamer
