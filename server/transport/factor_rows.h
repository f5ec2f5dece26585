#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "server/scene/render_scene.h"

namespace metamer {

/// Everything by which a scene multiplies light, as numbered rows: white (1 everywhere), the
/// scene's properties, and the nodes of each exact Fresnel term (fresnel_table.h). Methods keep a
/// table of what each row is to them; nothing here has wavelengths.
class FactorRows {
 public:
  explicit FactorRows(const RenderScene& scene);

  static constexpr std::uint32_t white = 0;
  std::uint32_t size() const { return size_; }

  /// A material's rows.
  struct Surface {
    FresnelKind fresnel;
    std::uint32_t diffuse, specular;
    std::uint32_t first_node;  ///< Where the Fresnel term is exact.
  };
  const Surface& surface(std::uint32_t material) const { return surfaces_[material]; }

  /// What a mirror does to light that meets it at `cosine`: a weighted sum of one or two rows.
  struct Factor {
    std::array<std::uint32_t, 2> row;
    std::array<float, 2> weight;
    int count;
  };
  Factor mirror(std::uint32_t material, float cosine) const;

  /// Gives each row's values at `nm`, in the order of the rows.
  void for_each(
      const RenderScene& scene, const std::vector<double>& nm,
      const std::function<void(std::uint32_t row, std::vector<double> values)>& take) const;

 private:
  std::vector<Surface> surfaces_;
  std::uint32_t size_;
};

}  // namespace metamer
