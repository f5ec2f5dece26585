#include "client/relight/signature_colors.h"

#include <algorithm>
#include <list>
#include <map>
#include <set>
#include <span>

#include "client/relight/chain_products.h"
#include "client/relight/reradiated_lights.h"
#include "common/transport/message_tables.h"
#include "common/transport/scene_bands.h"

namespace metamer::client {
namespace {

using Row = std::vector<float>;

/// Σ a b in 16 partial sums: vectorised whatever the compiler may assume of addition.
float integrate(std::span<const float> a, std::span<const float> b) {
  constexpr std::size_t lanes = 16;
  float sums[lanes] = {};
  const std::size_t whole = a.size() / lanes * lanes;
  for (std::size_t i = 0; i < whole; i += lanes)
    for (std::size_t j = 0; j < lanes; ++j) sums[j] += a[i + j] * b[i + j];
  for (std::size_t i = whole; i < a.size(); ++i) sums[i - whole] += a[i] * b[i];
  for (std::size_t width = lanes / 2; width > 0; width /= 2)
    for (std::size_t j = 0; j < width; ++j) sums[j] += sums[j + width];
  return sums[0];
}

/// The factors that light meets on its way, and how many at most.
SceneBands bands_of(const v1::TileFactors& tables, const v1::SceneFactors& scene,
                    const FactorSources& sources, const ReradiatedLights& reradiated,
                    const Observer& observer) {
  std::set<std::pair<FactorKind, std::uint32_t>> passed;
  std::vector<unsigned> length{0};
  const MessageTerms terms(tables);
  for (const MessageTerms::Chain& chain : terms.chains()) {
    if (&chain == terms.chains().data()) continue;
    passed.insert({chain.factor.kind, chain.factor.index});
    length.push_back(length[chain.parent] + 1);
  }
  std::list<Spectrum> powers;
  std::vector<const Spectrum*> emissions;
  for (const auto& light : scene.light())
    emissions.push_back(&powers.emplace_back(to_spectrum(light.power())));
  for (const ReradiatedLights::Light& light : reradiated.all()) emissions.push_back(&light.power);
  return {sources, passed, *std::max_element(length.begin(), length.end()), emissions, observer};
}

/// What is seen of each light that comes from a factor, by band; each is made when it is first
/// asked for.
class Sensors {
 public:
  Sensors(const SceneBands& bands, const v1::SceneFactors& scene, const FactorSources& sources,
          const ReradiatedLights& reradiated)
      : bands_(bands),
        scene_(scene),
        reradiated_(reradiated),
        at_edges_(sources, bands.bands().edges),
        at_bands_(sources, bands.bands().nm) {}

  const Row& operator()(std::uint32_t light, const FactorNode& factor) {
    const auto [entry, is_new] = sensors_.try_emplace({light, factor});
    if (is_new) entry->second = make(light, factor);
    return entry->second;
  }

 private:
  Row make(std::uint32_t light, const FactorNode& factor) {
    if (const auto own = reradiated_.of(light, factor)) return make_reradiated(*own);
    const bool is_linear = SceneBands::is_linear(factor.kind);
    const std::vector<double>& seen = is_linear ? seen_of(light, factor) : seen_of_white(light);
    const double luminance = scene_.light(static_cast<int>(light)).luminance();
    Row row;
    for (std::size_t i = 0; i < seen.size(); ++i)
      row.push_back(static_cast<float>(luminance * seen[i] *
                                       (is_linear ? 1.0 : double{at_bands_(factor)[i]})));
    return row;
  }

  /// The bands have these lights behind the scene's.
  Row make_reradiated(std::size_t light) {
    const double luminance = reradiated_.all()[light].luminance;
    Row row;
    for (const double seen : bands_.sensors(static_cast<std::size_t>(scene_.light_size()) + light,
                                            at_edges_({FactorKind::white, 0, 0})))
      row.push_back(static_cast<float>(luminance * seen));
    return row;
  }

  std::vector<double> seen_of(std::uint32_t light, const FactorNode& factor) {
    return bands_.sensors(light, at_edges_(factor));
  }
  const std::vector<double>& seen_of_white(std::uint32_t light) {
    const auto [entry, is_new] = white_.try_emplace(light);
    if (is_new) entry->second = seen_of(light, {FactorKind::white, 0, 0});
    return entry->second;
  }

  const SceneBands& bands_;
  const v1::SceneFactors& scene_;
  const ReradiatedLights& reradiated_;
  FactorValues<float> at_edges_, at_bands_;
  std::map<std::pair<std::uint32_t, FactorNode>, Row> sensors_;
  std::map<std::uint32_t, std::vector<double>> white_;  ///< By light.
};

}  // namespace

std::vector<Color> signature_colors(const v1::TileFactors& tables, const v1::SceneFactors& scene,
                                    const Observer& observer) {
  const SceneSources sources(scene);
  const ReradiatedLights reradiated(tables, scene, observer);
  const SceneBands bands = bands_of(tables, scene, sources.factors(), reradiated, observer);
  Sensors sensors(bands, scene, sources.factors(), reradiated);
  const auto& first = bands.bands().first;
  std::vector<Color> colors;
  fold(MessageTerms(tables),
       ChainProducts(scene, bands.bands().nm,
                     [&](const Row& product, std::uint32_t light, const FactorNode& factor) {
                       const Row& sensor = sensors(light, factor);
                       Color& color = colors.emplace_back();
                       for (std::size_t axis = 0; axis < 3; ++axis) {
                         const std::size_t count = first[axis + 1] - first[axis];
                         color.value[axis] =
                             integrate(std::span(product).subspan(first[axis], count),
                                       std::span(sensor).subspan(first[axis], count));
                       }
                     }));
  return colors;
}

}  // namespace metamer::client
