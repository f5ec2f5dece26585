#pragma once

#include "server/methods/band_table.h"
#include "server/transport/factor_rows.h"
#include "server/transport/gather.h"

/// Loops over `n` bands, n a multiple of band_pad, of rows that do not overlap.
namespace metamer::band_loops {

using Row = float* __restrict;
using ConstRow = const float* __restrict;

inline void add_term(std::size_t n, Row carrier, ConstRow light, ConstRow row, float weight) {
  for (std::size_t i = 0; i < n; ++i) carrier[i] += light[i] * (weight * row[i]);
}

/// The three lobes of a surface under one light.
inline void add_lobes(std::size_t n, Row carrier, ConstRow light, ConstRow diffuse,
                      ConstRow specular, const LobeWeights& w) {
  if (w.specular == 0 && w.white == 0) {
    if (w.diffuse != 0) add_term(n, carrier, light, diffuse, w.diffuse);
    return;
  }
  for (std::size_t i = 0; i < n; ++i)
    carrier[i] += light[i] * (w.diffuse * diffuse[i] + (w.specular * specular[i] + w.white));
}

/// The three lobes of a surface, of which each has a sensor by band (ExactTables).
inline void add_sensors(std::size_t n, Row carrier, ConstRow diffuse, ConstRow specular,
                        ConstRow white, const LobeWeights& w) {
  if (w.specular == 0 && w.white == 0) {
    for (std::size_t i = 0; i < n; ++i) carrier[i] += w.diffuse * diffuse[i];
    return;
  }
  for (std::size_t i = 0; i < n; ++i)
    carrier[i] += w.diffuse * diffuse[i] + (w.specular * specular[i] + w.white * white[i]);
}

/// Light that goes over a factor: one row of `values`, or a weighted sum of two.
inline void add_over(std::size_t n, Row carrier, ConstRow incoming, const BandTable& values,
                     const FactorRows::Mix& mix) {
  ConstRow first = values.row(mix.row[0]);
  if (mix.count == 1) {
    for (std::size_t i = 0; i < n; ++i) carrier[i] += incoming[i] * first[i];
    return;
  }
  ConstRow second = values.row(mix.row[1]);
  const float w = mix.weight[0], v = mix.weight[1];
  for (std::size_t i = 0; i < n; ++i) carrier[i] += incoming[i] * (w * first[i] + v * second[i]);
}

/// The sum of 16 partial sums: vectorised whatever the compiler may assume of addition, and more
/// exact than one running sum.
inline float total(float (&sums)[band_pad]) {
  for (std::size_t width = band_pad / 2; width > 0; width /= 2)
    for (std::size_t j = 0; j < width; ++j) sums[j] += sums[j + width];
  return sums[0];
}

/// Σ a b.
inline float dot(std::size_t n, ConstRow a, ConstRow b) {
  float sums[band_pad] = {};
  for (std::size_t i = 0; i < n; i += band_pad)
    for (std::size_t j = 0; j < band_pad; ++j) sums[j] += a[i + j] * b[i + j];
  return total(sums);
}

/// Σ a b c.
inline float dot(std::size_t n, ConstRow a, ConstRow b, ConstRow c) {
  float sums[band_pad] = {};
  for (std::size_t i = 0; i < n; i += band_pad)
    for (std::size_t j = 0; j < band_pad; ++j) sums[j] += a[i + j] * b[i + j] * c[i + j];
  return total(sums);
}

}  // namespace metamer::band_loops
