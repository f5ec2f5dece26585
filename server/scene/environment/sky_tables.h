#pragma once

#include <vector>

#include "server/scene/environment/sky_picture.h"

namespace metamer {

/// Where the light of a picture comes from, as importance sampling looks it up: first a row, then a
/// pixel in it (M. Pharr, W. Jakob and G. Humphreys (2023), 12.5).
struct SkyTables {
  double ground = 1;               ///< By which values of the picture are divided,
  std::vector<double> luminances;  ///< and by which they count: those of its lights, none 0.
  std::vector<float> up_to_row;    ///< Share of the light in the rows before it; height + 1.
  std::vector<float> up_to_pixel;  ///< Share of the row's light up to and with a pixel.
  std::vector<float> edges;        ///< cos θ where rows begin; height + 1.
  double whole = 0;                ///< ∫ of brightness() over the sphere.

  float radiance(float value) const { return static_cast<float>(double{value} / ground); }
  /// A pixel's luminance, nearly; the choice of samples alone depends on it.
  double brightness(std::span<const float> values) const {
    double sum = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
      sum += luminances[i] * double{radiance(values[i])};
    return sum;
  }
};

/// `luminances`: of the light of each value of a pixel; `ground` (above 0): Y of a perfect white
/// that faces +y, by the picture's values. Takes time with each pixel.
SkyTables sky_tables(const SkyPicture& picture, std::vector<double> luminances, double ground);

}  // namespace metamer
