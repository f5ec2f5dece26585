#pragma once

#include <array>
#include <map>
#include <vector>

#include "common/transport/factor_values.h"
#include "server/scene/render_scene.h"
#include "server/transport/gather.h"
#include "tests/server/methods/lamps.h"

namespace metamer::promises {

/// What a scene's pixels look like, by plain sums over 0.005 nm: no cell, no shares of them, no
/// bands. Each product of a light and factors is summed once. For scenes whose spectra bend at
/// multiples of 0.005 nm alone, or that are lines.
class PlainTruth {
 public:
  /// `scene` must outlive it.
  PlainTruth(const RenderScene& scene, const Observer& observer);

  /// X Y Z, `scale` times the sums of `gather`.
  Xyz resolve(const Gather& gather, double scale);
  /// Of the first light that is seen.
  Xyz white() const { return white_; }
  std::size_t products() const { return products_.size(); }

 private:
  struct Fold;
  /// A light, and the nodes that it meets.
  struct Product {
    std::uint32_t light;
    std::vector<FactorNode> nodes;
    auto operator<=>(const Product&) const = default;
  };

  const Xyz& xyz_of(const Product& product);

  std::vector<test::PlainSum> lights_;
  std::vector<double> luminances_;
  FactorValues<double> factors_;
  std::map<Product, Xyz> products_;
  Xyz white_{1, 1, 1};
};

}  // namespace metamer::promises
