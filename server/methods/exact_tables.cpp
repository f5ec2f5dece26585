#include "server/methods/exact_tables.h"

#include <algorithm>
#include <numeric>

#include "server/methods/costs.h"
#include "server/transport/mirror.h"

namespace metamer {
namespace {

/// Of chains over clear surfaces and of those between diffuse ones. Longer ones hold more than four
/// reflections, of 4 % each, or many transmissions, which are nearly grey, or are dark but for
/// greys.
constexpr std::uint32_t longest_probed = 12;

/// Two factors each.
bool has_rough_mirrors(const RenderScene& scene) {
  return std::any_of(scene.materials.begin(), scene.materials.end(), [](const RenderMaterial& m) {
    return m.mirror > 0 && m.has(models::diffracting);
  });
}

SceneBands scene_bands(const RenderScene& scene, const Observer& observer, std::uint32_t depth,
                       std::uint32_t bounces) {
  std::set<std::pair<FactorKind, std::uint32_t>> passed;
  for (std::uint32_t i = 0; i < scene.materials.size(); ++i)
    if (scene.materials[i].mirror > 0)
      passed.insert({mirror_factor(scene.materials[i], i, 1).kind, i});
  std::vector<const Spectrum*> emissions;
  for (const Spectrum& emission : scene.emissions) emissions.push_back(&emission);
  for (const RenderScene::Reradiated& one : scene.reradiated) emissions.push_back(&one.power);
  std::uint32_t longest = passed.empty() ? 0 : depth;
  if (has_rough_mirrors(scene)) longest = std::max(longest, std::min(2 * longest, longest_probed));
  // At each clear surface an interface, and a way through what lies behind it; to the light again.
  if (!scene.media.empty()) longest = std::min(2 * depth + 4, longest_probed);
  if (bounces > 0) {
    longest = std::min(longest + bounces, longest_probed);
    for (const std::uint32_t i : seen_materials(scene)) passed.insert({FactorKind::diffuse, i});
  }
  return {factor_sources(scene), passed, longest, emissions, observer};
}

}  // namespace

ExactTables::ExactTables(const RenderScene& scene, const Observer& observer, std::uint32_t depth,
                         std::uint32_t bounces)
    : bands(scene_bands(scene, observer, depth, bounces)),
      rows(scene),
      white(scene.emissions.size(), bands.bands().nm.size()),
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

  for (const RenderScene::Reradiated& one : scene.reradiated)
    reradiated.push_back(static_cast<float>(one.luminance));

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
  for (const std::uint32_t material : rows.fluorescent())
    for (std::size_t i = 0; i < 3 * lights.size(); ++i)
      direct.push_back(direct_color(rows.diffuse(material))[i] +
                       direct_color(rows.row({FactorKind::reradiate, material, 0}))[i]);
}

BandTable ExactTables::sensors(std::uint32_t row) const {
  BandTable seen(emissions(), values.bands());
  const auto fluorescence = rows.fluorescence(row);
  const std::size_t fluorescences = reradiated.size() / std::max<std::size_t>(1, emissions());
  for (std::size_t light = 0; light < emissions(); ++light) {
    if (fluorescence) {
      const std::size_t own = light * fluorescences + *fluorescence;
      const std::vector<float> ones(at_edges.bands(), reradiated[own]);
      seen.set(light, bands.sensors(emissions() + own, ones));
      continue;
    }
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
  const std::size_t bent = is_linear.size() - lines;
  const std::size_t size = values.bands() + at_edges.bands();
  return costs::table(lines, (1 + 3 * emissions()) * size) +
         costs::table(4 * bent, values.bands()) +
         costs::band_choice(bands.bands().curve_count, bands.lights());
}

/// Each signature is X Y Z already.
DirectTables ExactTables::direct_tables() const {
  std::vector<std::vector<float>> colors;
  const std::size_t size = 3 * lights.size();
  for (auto row = direct.begin(); row != direct.end(); row += static_cast<std::ptrdiff_t>(size))
    colors.emplace_back(row, row + static_cast<std::ptrdiff_t>(size));
  return tables_of_colors(colors);
}

}  // namespace metamer
