#pragma once

#include <vector>

#include "common/transport/message_tables.h"
#include "metamer/v1/factors.pb.h"
#include "server/film/pixel_sink.h"
#include "server/scene/render_scene.h"

namespace metamer {

/// Keeps what each pixel of a tile received as pairs of signature and weight, for relighting, and
/// hands it on. Unlike the rows of a method, its factors name materials: two that share a spectrum
/// today can be given different ones tomorrow.
class FactorSink : public PixelSink {
 public:
  /// `next` must outlive it.
  FactorSink(PixelSink& next, std::uint32_t spp);

  void begin(const Rect& tile);
  void take(std::uint32_t x, std::uint32_t y, const Gather& gather) override;
  /// The tile since begin(). Empty lists where a chain has more than max_parts products: then
  /// overflowed() says so from there on.
  v1::TileFactors finish();

  /// A chain of factors that lie between nodes is a sum of up to 2 ^ factors products.
  static constexpr std::size_t max_parts = 4096;
  bool overflowed() const { return overflowed_; }

 private:
  struct Fold;
  /// A chain is a weighted sum of products of nodes.
  struct Part {
    std::uint32_t product;
    float weight;
  };
  struct Pair {
    std::uint32_t signature;
    float weight;
  };

  std::vector<Part> longer(const std::vector<Part>& parent, const Factor& factor);
  void add(std::uint32_t signature, float weight);

  PixelSink& next_;
  float scale_;
  Rect tile_{};
  MessageTables tables_;
  std::vector<std::vector<Pair>> pixels_;  ///< Row by row.
  std::vector<float> sums_;                ///< Of the pixel under way, by signature.
  std::vector<std::uint32_t> touched_;     ///< Signatures of the pixel under way.
  bool overflowed_ = false;
};

/// The spectra that factors are multiplied by, as this scene has them.
v1::SceneFactors scene_factors(const RenderScene& scene);

}  // namespace metamer
