#pragma once

#include <array>
#include <memory>

#include "server/cpu/lanes.h"
#include "server/cpu/soft/pattern.h"
#include "server/scene/render_scene.h"

namespace metamer::cpu::soft {

/// Light from all around. Half of the samples go where the picture is bright, half where a white
/// reflects most; what both give is weighed by the balance heuristic of E. Veach and L. J. Guibas,
/// "Optimally Combining Sampling Techniques for Monte Carlo Rendering" (1995).
class Sky {
 public:
  explicit Sky(const RenderScene& scene);  ///< Which has an environment.

  /// What the picture has in a direction: a value each for the lights of the environment.
  const float* values(const Eigen::Vector3f& direction) const;
  /// By a light's luminance.
  float radiance(float value) const { return tables_ ? tables_->radiance(value) : value; }
  std::uint32_t first_light() const { return first_light_; }
  std::uint32_t light_count() const { return light_count_; }
  bool visible() const { return visible_; }

  struct Samples {
    Vectors direction{};
    Floats weight{};  ///< 1 / (π p) of the density p over solid angle.
    std::array<const float*, lane_count> values{};
  };
  /// Of one light; lanes that were not set have none.
  Floats radiance_of(const Samples& sample, std::uint32_t part) const {
    Floats radiances{};
    for (unsigned i = 0; i < lane_count; ++i)
      if (sample.values[i] != nullptr) radiances[i] = radiance(sample.values[i][part]);
    return radiances;
  }
  /// Sample number `index` of what a white with this normal sees; `seed` is the lane's. Sets one
  /// lane.
  void put_sample(const Eigen::Vector3f& white, std::uint32_t index, std::uint32_t seed,
                  Samples& sample, unsigned lane) const;

 private:
  struct Place {
    std::uint32_t x, y;
  };
  struct Found {
    std::array<float, 3> direction;
    Place place;
  };

  Place place_of(const std::array<float, 3>& direction) const;
  /// In the picture, by its luminances.
  Found bright(float u, float v) const;
  /// Its density there over solid angle.
  double density(Place place) const;
  std::array<float, 3> turned(const std::array<float, 3>& direction, float sine) const;

  std::uint32_t first_light_, light_count_;
  bool visible_;
  float cosine_, sine_;  ///< Of the rotation.
  std::shared_ptr<const SkyPicture> picture_;
  std::shared_ptr<const SkyTables> tables_;
};

}  // namespace metamer::cpu::soft
