#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace metamer {

/// The weights of a light's reflection, summed over the samples of a pixel: see lobes.glsl.
struct LobeWeights {
  float diffuse = 0, specular = 0, white = 0;
};

/// What a pixel receives, before any spectrum. Everything that does not depend on wavelength has
/// been multiplied and summed into weights, so spectral work is done once for each distinct
/// combination in the pixel instead of once for each sample:
///
///     L(λ) = Σ_surfaces throughput_path(λ) · Σ_lights Φ(λ) · (d C_D(λ) + s C_S(λ) + w + Σ_u f_u
///     F(u; λ))
///
/// A path is the sequence of mirrors between eye and surface; its throughput is the product of
/// their Fresnel terms, C_S where there is none. Path 0 goes straight from the eye. The same
/// combination is never stored twice. The cosines u of an exact Fresnel term fall on the nodes of a
/// table (fresnel_table.h).
class Gather {
 public:
  explicit Gather(std::size_t lights) : lights_(lights) { clear(); }

  struct Path {
    std::uint32_t parent;    ///< Its path without the last mirror; lower than its own index.
    std::uint32_t material;  ///< Of the last mirror.
    float cosine;            ///< At the last mirror; 0 where it has no Fresnel term.
  };
  struct Surface {
    std::uint32_t path, material;
  };

  void clear() {
    paths_.assign(1, {0, 0, 0});
    surfaces_.clear();
    weights_.clear();
    fresnel_.clear();
  }

  /// The path that continues `parent` over a mirror of `material`, met at `cosine`.
  std::uint32_t path(std::uint32_t parent, std::uint32_t material, float cosine) {
    for (std::size_t i = 1; i < paths_.size(); ++i)
      if (paths_[i].parent == parent && paths_[i].material == material &&
          paths_[i].cosine == cosine)
        return static_cast<std::uint32_t>(i);
    paths_.push_back({parent, material, cosine});
    return static_cast<std::uint32_t>(paths_.size() - 1);
  }

  /// The surface of `material` seen along `path`.
  std::uint32_t surface(std::uint32_t path, std::uint32_t material) {
    for (std::size_t i = 0; i < surfaces_.size(); ++i)
      if (surfaces_[i].path == path && surfaces_[i].material == material)
        return static_cast<std::uint32_t>(i);
    surfaces_.push_back({path, material});
    weights_.resize(weights_.size() + lights_);
    return static_cast<std::uint32_t>(surfaces_.size() - 1);
  }

  /// The weights that a surface gathers from one light.
  LobeWeights& weights(std::uint32_t surface, std::size_t light) {
    return weights_[surface * lights_ + light];
  }

  /// The weight of an exact Fresnel term that a surface gathers from one light at a node.
  struct FresnelWeight {
    std::uint32_t surface, light, node;
    float weight;
  };
  void add_fresnel(std::uint32_t surface, std::uint32_t light, std::uint32_t node, float weight) {
    // The samples of a pixel are much alike: look at the newest first.
    for (std::size_t i = fresnel_.size(); i-- > 0;) {
      FresnelWeight& one = fresnel_[i];
      if (one.node == node && one.light == light && one.surface == surface) {
        one.weight += weight;
        return;
      }
    }
    fresnel_.push_back({surface, light, node, weight});
  }

  std::span<const FresnelWeight> fresnel() const { return fresnel_; }
  std::span<const Path> paths() const { return paths_; }
  std::span<const Surface> surfaces() const { return surfaces_; }
  /// One for each light.
  std::span<const LobeWeights> weights(std::size_t surface) const {
    return std::span(weights_).subspan(surface * lights_, lights_);
  }

 private:
  std::size_t lights_;
  std::vector<Path> paths_;
  std::vector<Surface> surfaces_;
  std::vector<LobeWeights> weights_;
  std::vector<FresnelWeight> fresnel_;
};

}  // namespace metamer
