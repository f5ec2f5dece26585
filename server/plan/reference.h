#pragma once

#include <map>
#include <vector>

#include "common/color/xyz.h"
#include "common/scene/fresnel_table.h"
#include "common/spectral/cie.h"
#include "server/scene/render_scene.h"
#include "server/transport/gather.h"

namespace metamer {

/// What every method is measured against: point sampling at each nm from 360 to 830, in f64. Not
/// for rendering: it takes its time. Belongs to one thread.
class Reference {
 public:
  /// `scene` must outlive it.
  Reference(const RenderScene& scene, cie::Observer observer);

  /// The light of one pixel, `scale` times the sums of `gather`.
  Xyz resolve(const Gather& gather, double scale);

  /// The white of colour differences: a perfect white that faces the dominant light, the first one
  /// that the observer sees at all. Equal energy at Y = 1, where there is none.
  const Xyz& white() const { return white_; }

 private:
  using Values = std::vector<double>;
  void add_surface(const Gather& gather, std::size_t surface, Values& carrier) const;
  Values mirror(const Gather::Path& path);
  const Values& fresnel_row(std::uint32_t constants, std::uint32_t node);

  const RenderScene& scene_;
  ObserverWeights observer_;
  std::size_t bands_;
  std::vector<Values> lights_;      ///< With their luminance, E[3.2-4].
  std::vector<Values> properties_;  ///< At every nm.
  std::vector<ConstantsAt> constants_;
  std::map<std::pair<std::uint32_t, std::uint32_t>, Values> fresnel_rows_;
  Xyz white_{1, 1, 1};
};

}  // namespace metamer
