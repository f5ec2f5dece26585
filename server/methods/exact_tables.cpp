#include "server/methods/exact_tables.h"

#include "server/methods/band_loops.h"
#include "server/methods/costs.h"
#include "server/methods/scene_spectra.h"

namespace metamer {
ExactTables::ExactTables(const RenderScene& scene, const Observer& observer)
    : rows(scene),
      nm(surface_edges(scene)),
      values(rows.size(), nm.size()),
      sensors(3 * scene.lights.size(), nm.size()),
      lights(scene.lights.size()),
      direct(std::size_t{rows.size()} * lights * 3) {
  for (std::size_t i = 0; i < lights; ++i) {
    const RenderLight& light = scene.lights[i];
    ObserverWeights seen = under_light(observer, scene.emissions[light.emission], nm);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      for (double& value : seen.weights[axis]) value *= light.luminance;
      sensors.set(3 * i + axis, seen.weights[axis]);
    }
  }
  rows.for_each(scene, nm,
                [&](std::uint32_t row, const std::vector<double>& at) { values.set(row, at); });
  for (std::uint32_t row = 0; row < rows.size(); ++row)
    measure(values.row(FactorRows::white), row, &direct[row * lights * 3]);
}

void ExactTables::measure(const float* product, std::uint32_t row, float* xyz) const {
  for (std::size_t i = 0; i < 3 * lights; ++i)
    xyz[i] = band_loops::dot(values.stride(), product, values.row(row), sensors.row(i));
}

double ExactTables::preparation_cost() const {
  return costs::table(rows.size(), nm.size()) +
         static_cast<double>(3 * rows.size() * lights) * costs::loop(values.stride());
}

/// Each signature is X Y Z already.
DirectTables ExactTables::direct_tables() const {
  DirectTables tables{.size = 1,
                      .row_stride = static_cast<std::uint32_t>(lights),
                      .light_stride = 1,
                      .sensor_stride = 0,
                      .values = std::vector<float>(direct.size() / 3 * 4),
                      .sensors = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0},
                      .lights = {},
                      .observer = {}};
  for (std::size_t i = 0; i < direct.size(); ++i) tables.values[i / 3 * 4 + i % 3] = direct[i];
  return tables;
}

}  // namespace metamer
