#pragma once

#include "common/color/xyz.h"
#include "server/methods/banded.h"

namespace metamer {

/// What both ways of `exact` know of a scene. Rows are values at every whole nanometre from 360 to
/// 830 and wherever a surface's spectrum has a sample of its own; between these a product of rows
/// is a straight line.
struct ExactTables {
  ExactTables(const RenderScene& scene, const Observer& observer);

  /// X Y Z of `product` times a row, three for each light.
  void measure(const float* product, std::uint32_t row, float* xyz) const;

  /// The same of a row by itself.
  const float* direct_color(std::uint32_t row) const { return &direct[row * lights * 3]; }
  DirectTables direct_tables() const;
  double preparation_cost() const;

  FactorRows rows;
  std::vector<double> nm;  ///< Of the bands.
  BandTable values;        ///< A row for each of FactorRows.
  BandTable sensors;       ///< Three a light: what the observer sees of it, by band (under_light).
  std::size_t lights;
  std::vector<float> direct;  ///< X Y Z by row and light.
};

/// Names each product of rows, integrates each to X Y Z when it is first met, and looks it up.
std::unique_ptr<Method> make_exact_signatures(ExactTables tables);

/// Light that comes straight from a surface is looked up; what comes by mirrors is carried as one
/// value a band, and becomes X Y Z once a pixel. For scenes whose mirrors make more products than
/// can be looked up.
std::unique_ptr<Method> make_exact_bands(ExactTables tables, const RenderScene& scene,
                                         const Observer& observer);

}  // namespace metamer
