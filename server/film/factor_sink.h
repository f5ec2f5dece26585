#pragma once

#include <map>
#include <string>
#include <tuple>
#include <vector>

#include "metamer/v1/factors.pb.h"
#include "server/film/pixel_sink.h"
#include "server/scene/render_scene.h"

namespace metamer {

/// Keeps what each pixel of a tile received as pairs of signature and weight, for relighting, and
/// hands it on. Unlike the rows of a method, a signature names materials: two that share a spectrum
/// today can be given different ones tomorrow.
class FactorSink : public PixelSink {
 public:
  /// Both must outlive it.
  FactorSink(const RenderScene& scene, PixelSink& next, std::uint32_t spp);

  void begin(const Rect& tile);
  void take(std::uint32_t x, std::uint32_t y, const Gather& gather) override;
  /// The tile since begin(). Empty lists where a path has more than max_terms products: then
  /// overflowed() says so from there on.
  v1::TileFactors finish();

  /// Light over several mirrors with Fresnel terms is a sum of up to 2 ^ mirrors products.
  static constexpr std::size_t max_terms = 4096;
  bool overflowed() const { return overflowed_; }

 private:
  /// By what a surface multiplies light: material, term, node.
  using Factor = std::tuple<std::uint32_t, v1::FactorTerm, std::uint32_t>;
  struct Term {
    std::uint32_t product;
    float weight;
  };
  struct Pair {
    std::uint32_t signature;
    float weight;
  };

  std::uint32_t product(std::uint32_t parent, const Factor& factor);
  std::uint32_t signature(std::uint32_t product, std::uint32_t light, const Factor& factor);
  std::vector<Term> mirrored(const std::vector<Term>& parent, const Gather::Path& path);
  void add(std::uint32_t signature, float weight);
  void add_all(const std::vector<Term>& terms, std::uint32_t light, const Factor& factor,
               float weight);

  const RenderScene& scene_;
  PixelSink& next_;
  float scale_;
  Rect tile_{};
  v1::TileFactors tables_;
  std::map<std::pair<std::uint32_t, Factor>, std::uint32_t> products_;
  std::map<std::tuple<std::uint32_t, std::uint32_t, Factor>, std::uint32_t> signatures_;
  std::vector<std::vector<Pair>> pixels_;  ///< Row by row.
  std::vector<float> sums_;                ///< Of the pixel under way, by signature.
  std::vector<std::uint32_t> touched_;     ///< Signatures of the pixel under way.
  bool overflowed_ = false;
};

/// The spectra that factors are multiplied by, as this scene has them.
v1::SceneFactors scene_factors(const RenderScene& scene);

}  // namespace metamer
