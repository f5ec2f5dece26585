#include "common/transport/scene_bands.h"

#include <concepts>

namespace metamer {
namespace {

template <class Kind>
constexpr bool is_spectrum = std::same_as<typename Kind::Table, SpectrumTable>;

/// What a table is made of, whatever its kind has for a source.
std::vector<const Spectrum*> spectra_of(const Spectrum& source) { return {&source}; }
std::vector<const Spectrum*> spectra_of(const OpticalConstants& source) {
  return {&source.n, &source.k};
}

std::vector<const Spectrum*> spectra_of(const FactorSources::Material& source) {
  if (source.constants != nullptr)
    return {&source.constants->n, &source.constants->k, &lobe_grid()};
  return {source.specular, &lobe_grid()};
}
std::vector<const Spectrum*> spectra_of(const factors::Coherent::Source&) { return {&lobe_grid()}; }

/// The spectra that a scene's factors are, or are made of, each once.
struct Parts {
  std::vector<Spectrum> curves;           ///< What may be on a chain.
  std::vector<Spectrum> last;             ///< What may be at its end alone.
  std::vector<const Spectrum*> surfaces;  ///< What is a line between its samples.
  std::vector<const Spectrum*> all;

  /// Those that the table says, or the last node and two more: of a Fresnel term, light at right
  /// angles, and cosines of 0.4, 0.1.
  template <class Table>
  void add_nodes(const auto& source) {
    const std::vector<double> nm = dense_nm(spectra_of(source));
    if constexpr (requires { Table::typical_last(source, nm); }) {
      for (Spectrum& one : Table::typical_last(source, nm)) last.push_back(std::move(one));
      return;
    }
    const FactorTable table = Table::make(source, nm);
    if constexpr (requires { Table::typical(source); })
      for (const std::uint32_t node : Table::typical(source)) curves.push_back({nm, table(node)});
    else
      for (const double share : {1.0, 0.63, 0.32})
        curves.push_back({nm, table(static_cast<std::uint32_t>(share * (Table::nodes - 1)))});
  }
};

Parts parts_of(const FactorSources& sources,
               const std::set<std::pair<FactorKind, std::uint32_t>>& passed) {
  Parts parts;
  std::set<const void*> known;
  std::set<std::pair<bool, const void*>> on_chains;  // a spectrum, or a table
  for (const FactorEntry& entry : factor_entries)
    with_kind(entry.kind, [&]<class Kind>(Kind) {
      // What is re-radiated is a light.
      if constexpr (!std::same_as<Kind, factors::Reradiate>)
        for (std::uint32_t index = 0; index < Kind::count(sources); ++index) {
          const auto* source = Kind::source(sources, index);
          if (source == nullptr) continue;
          if (known.insert(source).second) {
            for (const Spectrum* spectrum : spectra_of(*source)) parts.all.push_back(spectrum);
            if constexpr (is_spectrum<Kind>) parts.surfaces.push_back(source);
          }
          if constexpr (is_spectrum<Kind>) {
            if (passed.contains({entry.kind, index}) && on_chains.insert({true, source}).second)
              parts.curves.push_back(*source);
          } else if (on_chains.insert({false, source}).second) {
            parts.template add_nodes<typename Kind::Table>(*source);
          }
        }
    });
  return parts;
}

}  // namespace

bool SceneBands::is_linear(FactorKind kind) {
  return with_kind(kind, []<class Kind>(Kind) { return is_spectrum<Kind>; });
}

SceneBands::SceneBands(const FactorSources& sources,
                       const std::set<std::pair<FactorKind, std::uint32_t>>& passed, unsigned depth,
                       const std::vector<const Spectrum*>& emissions, const Observer& observer) {
  const Parts parts = parts_of(sources, passed);
  const std::vector<double> edges = cell_edges(parts.all);
  std::vector<SeenLight> lights;
  for (const Spectrum* emission : emissions) lights.emplace_back(observer, *emission, edges);
  std::vector<const Spectrum*> once = sources.windows;
  for (const Spectrum& one : parts.last) once.push_back(&one);
  // Where the surface itself is no line, it is one more of the chain.
  bands_ = ChainBands(parts.curves, depth + 1, parts.surfaces, lights, once);
  for (const SeenLight& light : lights) sensors_.emplace_back(light, bands_);
}

}  // namespace metamer
