#pragma once

#include <cstdint>
#include <vector>

namespace metamer {

/// What a method makes of light that comes straight from a surface, for a GPU. There every method
/// is one sum. A light's lobes on a material, with weights w of the rows (FactorRows) r, give
///
///     X = Σ_i sensor_X,i Σ_r w_r value_r,i
///
/// and so Y and Z. Methods with bands have the rows' spectra as values and the observer's, times
/// the light's, as sensors; those that know each light on each row have these as values and share
/// three sensors; of a scene that re-radiates, all methods do. Vectors are padded with zeros to
/// whole groups of four.
struct DirectTables {
  std::uint32_t size = 0;           ///< Of a vector, in groups of four, as are all strides.
  std::uint32_t row_stride = 0;     ///< From a row's vector of values to the next row's,
  std::uint32_t light_stride = 0;   ///< and from a light's to the next light's; 0: shared.
  std::uint32_t sensor_stride = 0;  ///< From a light's three sensors to the next; 0: shared.
  std::vector<float> values, sensors;
  /// Of methods with bands, what the sensors are made of: a vector of each light's values, and the
  /// three of the observer. Empty where a method has none.
  std::vector<float> lights, observer;
};

/// Of methods that know X Y Z of each row under each light: by row, three a light.
DirectTables tables_of_colors(const std::vector<std::vector<float>>& colors);

}  // namespace metamer
