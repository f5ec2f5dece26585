#include "client/relight/relight.h"

#include <map>
#include <tuple>

#include "common/scene/fresnel_table.h"

namespace metamer {
namespace {

using Row = std::vector<float>;

Spectrum to_spectrum(const v1::SampledSpectrum& from) {
  return {{from.nm().begin(), from.nm().end()}, {from.values().begin(), from.values().end()}};
}

Row to_row(const std::vector<double>& values) { return {values.begin(), values.end()}; }

/// The scene's lights with their luminance, E[3.2-4] by every nm, at `nm`.
std::vector<std::vector<double>> light_rows(const v1::SceneFactors& scene, cie::Observer observer,
                                            const std::vector<double>& nm) {
  const Wavelengths all = observer_wavelengths();
  const ObserverWeights weights = observer_weights(observer, all);
  std::vector<std::vector<double>> rows;
  for (const auto& light : scene.light()) {
    const Spectrum power = to_spectrum(light.power());
    const double scale = luminance_scale(weights, resample(power, all.nm(), Outside::zero).values,
                                         light.luminance());
    rows.push_back(resample(power, nm, Outside::zero).values);
    for (double& value : rows.back()) value *= scale;
  }
  return rows;
}

/// By what the factors' terms and products multiply light at some wavelengths; made as they are
/// asked for.
class FactorRows {
 public:
  FactorRows(const v1::TileFactors& tables, const v1::SceneFactors& scene, std::vector<double> nm)
      : tables_(tables), scene_(scene), nm_(std::move(nm)), white_(nm_.size(), 1.0f) {
    products_.push_back(white_);
    for (int i = 0; i < tables.product_parent_size(); ++i) {
      Row row = products_[tables.product_parent(i)];
      const Row& factor =
          term(tables.product_material(i), tables.product_term(i), tables.product_node(i));
      for (std::size_t k = 0; k < row.size(); ++k) row[k] *= factor[k];
      products_.push_back(std::move(row));
    }
  }

  const Row& product(std::uint32_t index) const { return products_[index]; }

  const Row& term(std::uint32_t material, v1::FactorTerm term, std::uint32_t node) {
    if (term == v1::FACTOR_WHITE) return white_;
    const auto [place, is_new] = terms_.try_emplace({material, term, node});
    if (is_new) place->second = make(scene_.material(static_cast<int>(material)), term, node);
    return place->second;
  }

 private:
  Row make(const v1::SceneFactors::Material& material, v1::FactorTerm term,
           std::uint32_t node) const {
    if (term == v1::FACTOR_FRESNEL) {
      const OpticalConstants constants{to_spectrum(material.constants().n()),
                                       to_spectrum(material.constants().k())};
      return to_row(fresnel_at(resample(constants, nm_), fresnel_node(node)));
    }
    const bool diffuse = term == v1::FACTOR_DIFFUSE;
    return to_row(resample(to_spectrum(diffuse ? material.diffuse() : material.specular()), nm_,
                           Outside::hold)
                      .values);
  }

  const v1::TileFactors& tables_;
  const v1::SceneFactors& scene_;
  std::vector<double> nm_;
  Row white_;
  std::vector<Row> products_;
  std::map<std::tuple<std::uint32_t, v1::FactorTerm, std::uint32_t>, Row> terms_;
};

/// Σ a b c in 16 partial sums: vectorised whatever the compiler may assume of addition.
float integrate(const Row& a, const Row& b, const Row& c) {
  constexpr std::size_t lanes = 16;
  float sums[lanes] = {};
  const std::size_t whole = a.size() / lanes * lanes;
  for (std::size_t i = 0; i < whole; i += lanes)
    for (std::size_t j = 0; j < lanes; ++j) sums[j] += a[i + j] * b[i + j] * c[i + j];
  for (std::size_t i = whole; i < a.size(); ++i) sums[i - whole] += a[i] * b[i] * c[i];
  for (std::size_t width = lanes / 2; width > 0; width /= 2)
    for (std::size_t j = 0; j < width; ++j) sums[j] += sums[j + width];
  return sums[0];
}

/// X Y Z and nothing: four lanes.
struct alignas(16) Color {
  float value[4];
};

std::vector<Color> signature_colors(const v1::TileFactors& tables, const v1::SceneFactors& scene,
                                    cie::Observer observer) {
  const Wavelengths wavelengths = observer_wavelengths();
  const ObserverWeights weights = observer_weights(observer, wavelengths);
  std::vector<std::array<Row, 3>> sensors;  // Φ x̄ Δλ and so on, a light each
  for (const std::vector<double>& light : light_rows(scene, observer, wavelengths.nm())) {
    std::array<Row, 3>& sensor = sensors.emplace_back();
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t k = 0; k < light.size(); ++k)
        sensor[axis].push_back(static_cast<float>(light[k] * weights.weights[axis][k]));
  }

  FactorRows rows(tables, scene, wavelengths.nm());
  std::vector<Color> colors;
  for (int i = 0; i < tables.signature_product_size(); ++i) {
    const Row& product = rows.product(tables.signature_product(i));
    const Row& term =
        rows.term(tables.signature_material(i), tables.signature_term(i), tables.signature_node(i));
    const std::array<Row, 3>& sensor = sensors[tables.signature_light(i)];
    colors.push_back({{integrate(product, term, sensor[0]), integrate(product, term, sensor[1]),
                       integrate(product, term, sensor[2]), 0}});
  }
  return colors;
}

}  // namespace

Image relight(const Factors& factors, const v1::SceneFactors& scene, cie::Observer observer) {
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
                       cie::Observer observer, const Wavelengths& wavelengths) {
  // The light of each signature.
  const auto lights = light_rows(scene, observer, wavelengths.nm());
  FactorRows rows(factors.tables, scene, wavelengths.nm());
  const v1::TileFactors& tables = factors.tables;
  std::vector<Row> spectra;
  for (int i = 0; i < tables.signature_product_size(); ++i) {
    Row row = rows.product(tables.signature_product(i));
    const Row& term =
        rows.term(tables.signature_material(i), tables.signature_term(i), tables.signature_node(i));
    const std::vector<double>& light = lights[tables.signature_light(i)];
    for (std::size_t k = 0; k < row.size(); ++k)
      row[k] = static_cast<float>(light[k] * double{row[k]} * double{term[k]});
    spectra.push_back(std::move(row));
  }

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

double seen_share(const v1::SceneFactors::Light& light, cie::Observer observer,
                  const Wavelengths& wavelengths) {
  const Spectrum power = to_spectrum(light.power());
  const auto luminance = [&](const Wavelengths& at) {
    return to_xyz(observer_weights(observer, at),
                  resample(power, at.nm(), Outside::zero).values)[1];
  };
  const double all = luminance(observer_wavelengths());
  return all > 0 ? luminance(wavelengths) / all : 1;
}

std::optional<Xyz> source_white(const v1::SceneFactors& scene, cie::Observer observer) {
  if (scene.light().empty()) return std::nullopt;
  const Wavelengths all = observer_wavelengths();
  const ObserverWeights weights = observer_weights(observer, all);
  const auto power = resample(to_spectrum(scene.light(0).power()), all.nm(), Outside::zero).values;
  const double scale = luminance_scale(weights, power, 1);
  if (!(scale > 0)) return std::nullopt;
  Xyz white = to_xyz(weights, power);
  for (double& value : white) value *= scale;
  return white;
}

}  // namespace metamer
