#include "client/relight/relight.h"

#include <algorithm>
#include <list>
#include <map>
#include <set>
#include <span>

#include "client/relight/scene_sources.h"
#include "common/scene/settings.h"
#include "common/transport/factor_values.h"
#include "common/transport/fold.h"
#include "common/transport/message_tables.h"
#include "common/transport/scene_bands.h"

namespace metamer::client {
namespace {

using Row = std::vector<float>;

/// The band means of the scene's lights, with their luminance, E[3.2-4].
std::vector<std::vector<double>> light_rows(const v1::SceneFactors& scene, const Observer& observer,
                                            const std::vector<double>& nm) {
  std::vector<std::vector<double>> rows;
  for (const auto& light : scene.light()) {
    const Spectrum power = to_spectrum(light.power());
    const double y = emission_xyz(power, observer)[1];
    rows.push_back(band_means(power, nm));
    for (double& value : rows.back()) value *= y > 0 ? light.luminance() / y : 0;
  }
  return rows;
}

/// Makes the product of each chain, and gives those of each term to `take`: chain's product, light,
/// factor's node.
template <class Take>
struct Products : FoldHooks {
  Products(const v1::SceneFactors& scene, const std::vector<double>& nm, Take take)
      : sources(scene), factors(sources.factors(), nm), chains{Row(nm.size(), 1.0f)}, take(take) {}

  void enter(std::uint32_t, std::uint32_t parent, const FactorNode& factor) {
    Row row = chains[parent];
    const Row& values = factors(factor);
    for (std::size_t k = 0; k < row.size(); ++k) row[k] *= values[k];
    chains.push_back(std::move(row));
  }

  void term(std::uint32_t chain, std::uint32_t light, const FactorNode& factor, float) {
    take(chains[chain], light, factor);
  }

  SceneSources sources;
  FactorValues<float> factors;
  std::vector<Row> chains;
  Take take;
};

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

/// X Y Z and nothing: four lanes.
struct alignas(16) Color {
  float value[4];
};

/// The factors that light meets on its way, and how many at most.
SceneBands bands_of(const v1::TileFactors& tables, const v1::SceneFactors& scene,
                    const FactorSources& sources, const Observer& observer) {
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
  return {sources, passed, *std::max_element(length.begin(), length.end()), emissions, observer};
}

/// What is seen of each light that comes from a factor, by band; each is made when it is first
/// asked for.
class Sensors {
 public:
  Sensors(const SceneBands& bands, const v1::SceneFactors& scene, const FactorSources& sources)
      : bands_(bands),
        scene_(scene),
        at_edges_(sources, bands.bands().edges),
        at_bands_(sources, bands.bands().nm) {}

  const Row& operator()(std::uint32_t light, const FactorNode& factor) {
    const auto [entry, is_new] = sensors_.try_emplace({light, factor});
    if (is_new) entry->second = make(light, factor);
    return entry->second;
  }

 private:
  Row make(std::uint32_t light, const FactorNode& factor) {
    const bool is_linear = SceneBands::is_linear(factor.kind);
    const std::vector<double> seen =
        bands_.sensors(light, at_edges_(is_linear ? factor : FactorNode{FactorKind::white, 0, 0}));
    const double luminance = scene_.light(static_cast<int>(light)).luminance();
    Row row;
    for (std::size_t i = 0; i < seen.size(); ++i)
      row.push_back(static_cast<float>(luminance * seen[i] *
                                       (is_linear ? 1.0 : double{at_bands_(factor)[i]})));
    return row;
  }

  const SceneBands& bands_;
  const v1::SceneFactors& scene_;
  FactorValues<float> at_edges_, at_bands_;
  std::map<std::pair<std::uint32_t, FactorNode>, Row> sensors_;
};

std::vector<Color> signature_colors(const v1::TileFactors& tables, const v1::SceneFactors& scene,
                                    const Observer& observer) {
  const SceneSources sources(scene);
  const SceneBands bands = bands_of(tables, scene, sources.factors(), observer);
  Sensors sensors(bands, scene, sources.factors());
  const auto& first = bands.bands().first;
  std::vector<Color> colors;
  fold(MessageTerms(tables),
       Products(scene, bands.bands().nm,
                [&](const Row& product, std::uint32_t light, const FactorNode& factor) {
                  const Row& sensor = sensors(light, factor);
                  Color& color = colors.emplace_back();
                  for (std::size_t axis = 0; axis < 3; ++axis) {
                    const std::size_t count = first[axis + 1] - first[axis];
                    color.value[axis] = integrate(std::span(product).subspan(first[axis], count),
                                                  std::span(sensor).subspan(first[axis], count));
                  }
                }));
  return colors;
}

}  // namespace

Observer observer_of(const v1::Plan& plan, const v1::SceneFactors& scene) {
  if (scene.observer_size() != 3) return to_observer(plan.observer());
  return {plan.observer_file(),
          {to_spectrum(scene.observer(0)), to_spectrum(scene.observer(1)),
           to_spectrum(scene.observer(2))}};
}

Image relight(const Factors& factors, const v1::SceneFactors& scene, const Observer& observer) {
  const std::vector<Color> colors = signature_colors(factors.tables, scene, observer);
  Image image = make_image(static_cast<int>(factors.width), static_cast<int>(factors.height),
                           {"X", "Y", "Z"});
  float* to = image.pixels.data();
  std::size_t pair = 0;
  for (const std::uint32_t end : factors.end) {
    Color sum{};
    for (; pair < end; ++pair) {
      const Color& color = colors[factors.signature[pair]];
      for (std::size_t axis = 0; axis < 4; ++axis)
        sum.value[axis] += factors.weight[pair] * color.value[axis];
    }
    for (std::size_t axis = 0; axis < 3; ++axis) *to++ = sum.value[axis];
  }
  return image;
}

Image relight_spectral(const Factors& factors, const v1::SceneFactors& scene,
                       const Observer& observer, const Wavelengths& wavelengths) {
  // The light of each signature.
  const auto lights = light_rows(scene, observer, wavelengths.nm());
  std::vector<Row> spectra;
  const SceneSources sources(scene);
  FactorValues<float> values(sources.factors(), wavelengths.nm());
  fold(MessageTerms(factors.tables),
       Products(scene, wavelengths.nm(),
                [&](const Row& product, std::uint32_t light, const FactorNode& node) {
                  Row row = product;
                  const Row& factor = values(node);
                  for (std::size_t k = 0; k < row.size(); ++k)
                    row[k] =
                        static_cast<float>(lights[light][k] * double{row[k]} * double{factor[k]});
                  spectra.push_back(std::move(row));
                }));

  std::vector<std::string> names;
  for (const double nm : wavelengths.nm()) names.push_back(std::to_string(nm));
  Image image = make_image(static_cast<int>(factors.width), static_cast<int>(factors.height),
                           std::move(names));
  const std::size_t bands = wavelengths.size();
  std::size_t pair = 0;
  for (std::size_t pixel = 0; pixel < factors.end.size(); ++pixel) {
    float* to = image.pixels.data() + pixel * bands;
    for (; pair < factors.end[pixel]; ++pair) {
      const Row& from = spectra[factors.signature[pair]];
      for (std::size_t k = 0; k < bands; ++k) to[k] += factors.weight[pair] * from[k];
    }
  }
  return image;
}

double seen_share(const v1::SceneFactors::Light& light, const Observer& observer,
                  const Wavelengths& wavelengths) {
  const Spectrum power = to_spectrum(light.power());
  const double all = emission_xyz(power, observer)[1];
  const ObserverWeights weights = observer_of_bands(observer, wavelengths.nm());
  return all > 0 ? to_xyz(weights, band_means(power, wavelengths.nm()))[1] / all : 1;
}

std::optional<Xyz> source_white(const v1::SceneFactors& scene, const Observer& observer) {
  if (scene.light().empty()) return std::nullopt;
  const Xyz white = white_of(to_spectrum(scene.light(0).power()), observer);
  if (!(white[1] > 0)) return std::nullopt;
  return white;
}

}  // namespace metamer::client
