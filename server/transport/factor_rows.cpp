#include "server/transport/factor_rows.h"

#include <algorithm>
#include <concepts>
#include <map>
#include <typeindex>

#include "server/transport/expand.h"

namespace metamer {

FactorSources factor_sources(const RenderScene& scene) {
  FactorSources sources;
  for (const RenderMaterial& material : scene.materials)
    sources.materials.push_back(
        {&scene.properties[material.diffuse], &scene.properties[material.specular],
         material.fresnel == FresnelKind::exact ? &scene.constants[material.constants] : nullptr,
         absorbs(scene, material) ? &scene.properties[scene.media[material.medium].transmittance]
                                  : nullptr,
         material.fluorescence ? &scene.fluorescences[*material.fluorescence] : nullptr,
         material.has(models::diffracting)});
  for (const RenderInterface& interface : scene.interfaces)
    sources.interfaces.push_back(&scene.constants[interface.constants]);
  for (const Spectrum& window : scene.windows) sources.windows.push_back(&window);
  return sources;
}

Gather gather_for(const RenderScene& scene) {
  std::vector<bool> reradiates;
  if (!scene.fluorescences.empty())
    for (const RenderMaterial& material : scene.materials)
      reradiates.push_back(material.fluorescence.has_value());
  return Gather(scene.lights.size(), std::move(reradiates));
}

FactorRows::FactorRows(const RenderScene& scene) {
  const FactorSources sources = factor_sources(scene);
  for (std::uint32_t i = 0; i < scene.materials.size(); ++i)
    if (scene.materials[i].fluorescence) fluorescent_.push_back(i);
  // Factors of the same source share their rows.
  std::map<std::pair<std::type_index, const void*>, std::uint32_t> known;
  for (const FactorEntry& entry : factor_entries)
    with_kind(entry.kind, [&]<class Kind>(Kind) {
      const auto count = static_cast<std::uint32_t>(Kind::count(sources));
      first_.resize(std::max(first_.size(), count * factor_kind_count));
      for (std::uint32_t index = 0; index < count; ++index) {
        const auto* source = Kind::source(sources, index);
        if (source == nullptr) continue;
        const auto [place, is_new] =
            known.try_emplace({typeid(typename Kind::Table), source}, size_);
        if (is_new) {
          tables_.push_back({entry.kind, index});
          if (entry.kind == FactorKind::reradiate)
            reradiating_.push_back({size_, *scene.materials[index].fluorescence});
          size_ += Kind::Table::nodes;
        }
        first_[index * factor_kind_count + static_cast<std::size_t>(entry.kind)] = place->second;
      }
    });
}

std::optional<std::uint32_t> FactorRows::fluorescence(std::uint32_t row) const {
  for (const Reradiating& one : reradiating_)
    if (one.row == row) return one.fluorescence;
  return std::nullopt;
}

std::uint32_t FactorRows::direct_diffuse(std::uint32_t material) const {
  const auto place = std::lower_bound(fluorescent_.begin(), fluorescent_.end(), material);
  if (place == fluorescent_.end() || *place != material) return diffuse(material);
  return size_ + static_cast<std::uint32_t>(place - fluorescent_.begin());
}

FactorRows::Mix FactorRows::mix(const Factor& factor) const {
  const FactorNodes<float> nodes = expand<float>(factor);
  return {{row(nodes.node[0]), nodes.count > 1 ? row(nodes.node[1]) : white},
          nodes.weight,
          nodes.count};
}

void FactorRows::for_each(
    const RenderScene& scene, const std::vector<double>& nm,
    const std::function<void(std::uint32_t row, std::vector<double> values)>& take) const {
  const FactorSources sources = factor_sources(scene);
  std::uint32_t row = 0;
  for (const Table& own : tables_)
    with_kind(own.kind, [&]<class Kind>(Kind) {
      const FactorTable table = Kind::Table::make(*Kind::source(sources, own.index), nm);
      for (std::uint32_t node = 0; node < Kind::Table::nodes; ++node) take(row++, table(node));
    });
}

void FactorRows::for_each_spectrum(
    const RenderScene& scene,
    const std::function<void(std::uint32_t row, const Spectrum& spectrum)>& take) const {
  const FactorSources sources = factor_sources(scene);
  std::uint32_t row = 0;
  for (const Table& own : tables_)
    with_kind(own.kind, [&]<class Kind>(Kind) {
      if constexpr (std::same_as<typename Kind::Table, SpectrumTable>)
        take(row, *Kind::source(sources, own.index));
      row += Kind::Table::nodes;
    });
}

}  // namespace metamer
