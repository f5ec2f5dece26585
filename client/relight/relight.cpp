#include "client/relight/relight.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "client/relight/chain_products.h"
#include "client/relight/reradiated_lights.h"
#include "client/relight/rgb_colors.h"
#include "client/relight/signature_colors.h"
#include "common/scene/settings.h"
#include "common/transport/message_tables.h"

namespace metamer::client {
namespace {

using Row = std::vector<float>;

/// The band means of the scene's lights, with their luminance, E[3.2-4].
/// Behind them, those that are re-radiated.
std::vector<std::vector<double>> light_rows(const v1::SceneFactors& scene,
                                            const ReradiatedLights& reradiated,
                                            const Observer& observer,
                                            const std::vector<double>& nm) {
  std::vector<std::vector<double>> rows;
  for (const auto& light : scene.light()) {
    const Spectrum power = to_spectrum(light.power());
    const double y = emission_xyz(power, observer)[1];
    rows.push_back(band_means(power, nm));
    for (double& value : rows.back()) value *= y > 0 ? light.luminance() / y : 0;
  }
  for (const ReradiatedLights::Light& light : reradiated.all())
    rows.push_back(band_means(light.power, nm));
  return rows;
}

/// The pixels of so many pictures, side by side in lanes.
template <std::size_t Count>
class PixelFold {
 public:
  /// `colors` by picture and signature; the first picture stands in for those that are missing.
  PixelFold(const Factors& factors, std::span<const std::vector<Color>> colors)
      : factors_(factors), colors_(colors.front().size()) {
    for (std::size_t i = 0; i < colors_.size(); ++i)
      for (std::size_t p = 0; p < Count; ++p)
        std::copy_n(colors[p < colors.size() ? p : 0][i].value, 3, colors_[i].lane + 3 * p);
  }

  /// Pixels `first` to `last` of each picture.
  void operator()(std::size_t first, std::size_t last, std::span<Image> pictures) const {
    std::size_t pair = first == 0 ? 0 : factors_.end[first - 1];
    for (std::size_t pixel = first; pixel < last; ++pixel) {
      Lanes sum{};
      for (; pair < factors_.end[pixel]; ++pair) {
        const Lanes& color = colors_[factors_.signature[pair]];
        const float weight = factors_.weight[pair];
        for (std::size_t i = 0; i < lanes; ++i) sum.lane[i] += weight * color.lane[i];
      }
      for (std::size_t p = 0; p < pictures.size(); ++p)
        std::copy_n(sum.lane + 3 * p, 3, pictures[p].pixels.data() + 3 * pixel);
    }
  }

 private:
  static constexpr std::size_t lanes = (3 * Count + 3) / 4 * 4;
  struct alignas(16) Lanes {
    float lane[lanes] = {};
  };
  const Factors& factors_;
  std::vector<Lanes> colors_;
};

template <std::size_t Count>
void fold_pixels(const Factors& factors, std::span<const std::vector<Color>> colors,
                 std::span<Image> pictures) {
  const PixelFold<Count> fold_some(factors, colors);
  constexpr std::size_t grain = 16384;  // a tenth of a millisecond at least
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, factors.end.size(), grain),
                    [&](const auto& range) { fold_some(range.begin(), range.end(), pictures); });
}

}  // namespace

Observer observer_of(const v1::Plan& plan, const v1::SceneFactors& scene) {
  if (scene.observer_size() != 3) return to_observer(plan.observer());
  return {plan.observer_file(),
          {to_spectrum(scene.observer(0)), to_spectrum(scene.observer(1)),
           to_spectrum(scene.observer(2))}};
}

void relight(const Factors& factors, std::span<const v1::SceneFactors> scenes,
             const Observer& observer, std::vector<Image>& pictures) {
  std::vector<std::vector<Color>> colors(scenes.size());
  tbb::parallel_for(std::size_t{0}, scenes.size(), [&](std::size_t i) {
    colors[i] = signature_colors(factors.tables, scenes[i], observer);
  });
  const auto width = static_cast<int>(factors.width), height = static_cast<int>(factors.height);
  pictures.resize(scenes.size());
  for (Image& picture : pictures)
    if (picture.width != width || picture.height != height)
      picture = make_image(width, height, {"X", "Y", "Z"});
  for (std::size_t i = 0; i < pictures.size(); i += relit_together) {
    const std::size_t count = std::min(relit_together, pictures.size() - i);
    const auto fold_these = count == 1 ? fold_pixels<1> : fold_pixels<relit_together>;
    fold_these(factors, std::span(colors).subspan(i, count), std::span(pictures).subspan(i, count));
  }
}

Image relight(const Factors& factors, const v1::SceneFactors& scene, const Observer& observer) {
  std::vector<Image> pictures;
  relight(factors, std::span(&scene, 1), observer, pictures);
  return std::move(pictures.front());
}

Image relight_rgb(const Factors& factors, const v1::SceneFactors& scene, const Observer& observer) {
  const std::vector<Color> colors = rgb_colors(factors.tables, scene, observer);
  Image picture = make_image(static_cast<int>(factors.width), static_cast<int>(factors.height),
                             {"X", "Y", "Z"});
  fold_pixels<1>(factors, std::span(&colors, 1), std::span(&picture, 1));
  return picture;
}

Image relight_spectral(const Factors& factors, const v1::SceneFactors& scene,
                       const Observer& observer, const Wavelengths& wavelengths) {
  // The light of each signature.
  const ReradiatedLights reradiated(factors.tables, scene, observer);
  const auto lights = light_rows(scene, reradiated, observer, wavelengths.nm());
  const auto light_count = static_cast<std::size_t>(scene.light_size());
  std::vector<Row> spectra;
  const SceneSources sources(scene);
  FactorValues<float> values(sources.factors(), wavelengths.nm());
  fold(MessageTerms(factors.tables),
       ChainProducts(scene, wavelengths.nm(),
                     [&](const Row& product, std::uint32_t light, const FactorNode& node) {
                       Row row = product;
                       const Row& factor = values(node);
                       const auto own = reradiated.of(light, node);
                       const std::vector<double>& from = lights[own ? light_count + *own : light];
                       for (std::size_t k = 0; k < row.size(); ++k)
                         row[k] = static_cast<float>(from[k] * double{row[k]} * double{factor[k]});
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
