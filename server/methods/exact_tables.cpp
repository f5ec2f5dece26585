#include "server/methods/exact_tables.h"

#include <algorithm>
#include <numeric>

#include "server/methods/costs.h"
#include "server/transport/mirror.h"

namespace metamer {
namespace {

/// Of chains over clear surfaces. Longer ones hold more than four reflections, of 4 % each, or
/// many transmissions, which are nearly grey.
constexpr std::uint32_t longest_probed = 12;

SceneBands scene_bands(const RenderScene& scene, const Observer& observer, std::uint32_t depth) {
  std::set<std::pair<FactorKind, std::uint32_t>> mirrors;
  for (std::uint32_t i = 0; i < scene.materials.size(); ++i)
    if (scene.materials[i].mirror > 0)
      mirrors.insert({mirror_factor(scene.materials[i], i, 1).kind, i});
  std::vector<const Spectrum*> emissions;
  for (const Spectrum& emission : scene.emissions) emissions.push_back(&emission);
  std::uint32_t longest = mirrors.empty() ? 0 : depth;
  // At each clear surface an interface, and a way through what lies behind it; to the light again.
  if (!scene.media.empty()) longest = std::min(2 * depth + 4, longest_probed);
  return {factor_sources(scene), mirrors, longest, emissions, observer};
}

}  // namespace

ExactTables::ExactTables(const RenderScene& scene, const Observer& observer, std::uint32_t depth)
    : bands(scene_bands(scene, observer, depth)),
      rows(scene),
      white(bands.lights(), bands.bands().nm.size()),
      values(rows.size(), bands.bands().nm.size()),
      at_edges(rows.size(), bands.bands().edges.size()),
      is_linear(rows.size()) {
  rows.for_each(scene, bands.bands().nm,
                [&](std::uint32_t row, const std::vector<double>& at) { values.set(row, at); });
  rows.for_each_spectrum(scene, [&](std::uint32_t row, const Spectrum& spectrum) {
    at_edges.set(row, resample(spectrum, bands.bands().edges, Outside::hold).values);
    is_linear[row] = true;
  });
  for (const RenderLight& light : scene.lights)
    lights.push_back({light.emission, static_cast<float>(light.luminance)});

  white = sensors(FactorRows::white);
  const auto& first = bands.bands().first;
  for (std::uint32_t row = 0; row < rows.size(); ++row) {
    const BandTable seen = sensors(row);
    for (const Light& light : lights)
      for (std::size_t axis = 0; axis < 3; ++axis)
        direct.push_back(light.luminance *
                         std::accumulate(seen.row(light.emission) + first[axis],
                                         seen.row(light.emission) + first[axis + 1], 0.0f));
  }
}

BandTable ExactTables::sensors(std::uint32_t row) const {
  BandTable seen(bands.lights(), values.bands());
  for (std::size_t light = 0; light < bands.lights(); ++light) {
    if (is_linear[row]) {
      seen.set(light, bands.sensors(light, {at_edges.row(row), at_edges.bands()}));
      continue;
    }
    for (std::size_t i = 0; i < values.bands(); ++i)
      seen.row(light)[i] = white.row(light)[i] * values.row(row)[i];
  }
  return seen;
}

double ExactTables::preparation_cost() const {
  const auto lines = static_cast<std::size_t>(std::count(is_linear.begin(), is_linear.end(), true));
  const std::size_t bent = is_linear.size() - lines, emissions = bands.lights();
  const std::size_t size = values.bands() + at_edges.bands();
  return costs::table(lines, (1 + 3 * emissions) * size) + costs::table(4 * bent, values.bands()) +
         costs::band_choice(bands.bands().curve_count, emissions);
}

/// Each signature is X Y Z already.
DirectTables ExactTables::direct_tables() const {
  DirectTables tables{.size = 1,
                      .row_stride = static_cast<std::uint32_t>(lights.size()),
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
