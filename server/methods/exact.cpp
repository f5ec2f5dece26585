#include "server/methods/exact.h"

#include <unordered_map>

#include "common/color/xyz.h"
#include "common/scene/settings.h"
#include "common/transport/fold.h"
#include "server/methods/banded.h"

namespace metamer {
namespace {

/// What a thread keeps of chains: products of their rows (2 KiB each), and signatures.
constexpr std::size_t max_products = 1 << 13, max_signatures = 1 << 19;
/// A chain of factors that lie between nodes is a sum of 2 ^ factors products, up to here.
constexpr std::size_t max_parts = 16;

/// Σ a b c in 16 partial sums.
float integrate(std::size_t n, const float* __restrict a, const float* __restrict b,
                const float* __restrict c) {
  float sums[band_pad] = {};
  for (std::size_t i = 0; i < n; i += band_pad)
    for (std::size_t j = 0; j < band_pad; ++j) sums[j] += a[i + j] * b[i + j] * c[i + j];
  for (std::size_t width = band_pad / 2; width > 0; width /= 2)
    for (std::size_t j = 0; j < width; ++j) sums[j] += sums[j + width];
  return sums[0];
}

/// The product of the rows of a chain, by number; `direct` is that of the chain without any.
using Product = std::uint32_t;
constexpr Product direct = 0;

std::uint64_t key(Product product, std::uint32_t row) { return std::uint64_t{product} << 32 | row; }

/// A chain is a weighted sum of products.
struct Part {
  Product product;
  float weight;
};

struct Memory : Method::Scratch {
  std::vector<std::vector<float>> products;                      ///< [0] is not used.
  std::unordered_map<std::uint64_t, Product> longer;             ///< Product × row.
  std::unordered_map<std::uint64_t, std::vector<float>> colors;  ///< XYZ of product × row by light.
  std::vector<Part> parts;        ///< Of all of a pixel's chains, one after the other.
  std::vector<std::size_t> ends;  ///< Where each chain's parts end.

  /// Forgets everything before it grows too large; only between pixels.
  void bound() {
    if (products.size() < max_products && colors.size() < max_signatures) return;
    products.clear();
    longer.clear();
    colors.clear();
  }
};

class ExactMethod : public Method {
 public:
  /// `values`: a row for each of FactorRows. `sensors`: three rows a light, Φ x̄ Δλ and so on.
  ExactMethod(FactorRows rows, BandTable values, BandTable sensors, std::size_t lights)
      : rows_(std::move(rows)),
        values_(std::move(values)),
        sensors_(std::move(sensors)),
        lights_(lights) {
    direct_.resize(std::size_t{rows_.size()} * lights_ * 3);
    for (std::uint32_t row = 0; row < rows_.size(); ++row)
      measure(values_.row(FactorRows::white), row, &direct_[row * lights_ * 3]);
  }

  std::unique_ptr<Scratch> make_scratch() const override { return std::make_unique<Memory>(); }

  std::array<float, 3> resolve(const Gather& gather, float scale, Scratch& scratch) const override {
    auto& memory = static_cast<Memory&>(scratch);
    memory.bound();
    memory.parts.assign(1, {direct, 1});
    memory.ends.assign(1, 1);
    Fold carrier{{}, *this, memory, {}};
    fold(gather, carrier);
    for (float& value : carrier.xyz) value *= scale;
    return carrier.xyz;
  }

  /// Each signature is X Y Z already.
  DirectTables direct_tables() const override {
    DirectTables tables{.size = 1,
                        .row_stride = static_cast<std::uint32_t>(lights_),
                        .light_stride = 1,
                        .sensor_stride = 0,
                        .values = std::vector<float>(direct_.size() / 3 * 4),
                        .sensors = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0},
                        .lights = {},
                        .observer = {}};
    for (std::size_t i = 0; i < direct_.size(); ++i) tables.values[i / 3 * 4 + i % 3] = direct_[i];
    return tables;
  }

 private:
  /// Names the products of each chain, and sums what their signatures are worth.
  struct Fold : FoldHooks {
    const ExactMethod& method;
    Memory& memory;
    std::array<float, 3> xyz;

    void enter(std::uint32_t, std::uint32_t parent, const Factor& factor) {
      const FactorRows::Mix mix = method.rows_.mix(factor);
      const auto [begin, end] = parts_of(parent);
      const std::size_t first = memory.parts.size();
      for (std::size_t t = begin; t < end; ++t)
        for (std::size_t j = 0; j < mix.count; ++j) {
          if (mix.weight[j] == 0) continue;
          const Part part = memory.parts[t];
          memory.parts.push_back(
              {method.longer(part.product, mix.row[j], memory), part.weight * mix.weight[j]});
        }
      if (memory.parts.size() - first > max_parts) method.merge(first, memory);
      memory.ends.push_back(memory.parts.size());
    }

    void lobes(std::uint32_t chain, std::uint32_t material, std::span<const LobeWeights> weights) {
      const std::uint32_t diffuse = method.rows_.diffuse(material);
      const std::uint32_t specular = method.rows_.specular(material);
      const auto [begin, end] = parts_of(chain);
      for (std::size_t t = begin; t < end; ++t)
        add_lobes(memory.parts[t], diffuse, specular, weights);
    }

    void term(std::uint32_t chain, std::uint32_t light, const FactorNode& factor, float weight) {
      const std::uint32_t row = method.rows_.row(factor);
      const auto [begin, end] = parts_of(chain);
      for (std::size_t t = begin; t < end; ++t) {
        const Part& part = memory.parts[t];
        add(part.weight * weight, method.color(part.product, row, memory) + 3 * light);
      }
    }

   private:
    std::pair<std::size_t, std::size_t> parts_of(std::uint32_t chain) const {
      return {chain == 0 ? 0 : memory.ends[chain - 1], memory.ends[chain]};
    }

    void add(float weight, const float* color) {
      for (std::size_t i = 0; i < 3; ++i) xyz[i] += weight * color[i];
    }

    void add_lobes(const Part& part, std::uint32_t diffuse_row, std::uint32_t specular_row,
                   std::span<const LobeWeights> weights) {
      const float* diffuse = method.color(part.product, diffuse_row, memory);
      const float* specular = method.color(part.product, specular_row, memory);
      const float* white = method.color(part.product, FactorRows::white, memory);
      for (const LobeWeights& w : weights) {
        add(part.weight * w.diffuse, diffuse);
        if (w.specular != 0) add(part.weight * w.specular, specular);
        if (w.white != 0) add(part.weight * w.white, white);
        diffuse += 3;
        specular += 3;
        white += 3;
      }
    }
  };

  /// Makes one product of the parts from `first` on. It has no name and is met only once.
  void merge(std::size_t first, Memory& memory) const {
    std::vector<float> sum(stride());
    for (std::size_t t = first; t < memory.parts.size(); ++t) {
      const float* product = product_of(memory.parts[t].product, memory);
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] += memory.parts[t].weight * product[i];
    }
    memory.parts.resize(first);
    memory.parts.push_back({keep(std::move(sum), memory), 1});
  }

  static Product keep(std::vector<float> product, Memory& memory) {
    if (memory.products.empty()) memory.products.emplace_back();
    memory.products.push_back(std::move(product));
    return static_cast<Product>(memory.products.size() - 1);
  }

  const float* product_of(Product product, const Memory& memory) const {
    return product == direct ? values_.row(FactorRows::white) : memory.products[product].data();
  }

  Product longer(Product product, std::uint32_t row, Memory& memory) const {
    if (row == FactorRows::white) return product;
    const auto [place, is_new] = memory.longer.try_emplace(key(product, row), direct);
    if (is_new) {
      const float* shorter = product_of(product, memory);
      std::vector<float> values(shorter, shorter + stride());
      for (std::size_t i = 0; i < values.size(); ++i) values[i] *= values_.row(row)[i];
      place->second = keep(std::move(values), memory);
    }
    return place->second;
  }

  /// X Y Z of a signature for each light.
  const float* color(Product product, std::uint32_t row, Memory& memory) const {
    if (product == direct) return &direct_[row * lights_ * 3];
    std::vector<float>& own = memory.colors[key(product, row)];
    if (own.empty()) {
      own.resize(lights_ * 3);
      measure(product_of(product, memory), row, own.data());
    }
    return own.data();
  }

  void measure(const float* product, std::uint32_t row, float* xyz) const {
    for (std::size_t i = 0; i < 3 * lights_; ++i)
      xyz[i] = integrate(stride(), product, values_.row(row), sensors_.row(i));
  }

  std::size_t stride() const { return values_.stride(); }

  FactorRows rows_;
  BandTable values_, sensors_;
  std::size_t lights_;
  std::vector<float> direct_;  ///< XYZ by row and light.
};

}  // namespace

std::uint64_t direct_signatures(const RenderScene& scene) {
  return std::uint64_t{FactorRows(scene).size()} * scene.lights.size();
}

void plan_exact(const RenderScene& scene, const v1::Settings&, v1::Plan& plan) {
  plan.set_signatures(direct_signatures(scene));
}

std::unique_ptr<Method> make_exact(const v1::Plan& plan, const RenderScene& scene) {
  const Wavelengths wavelengths = observer_wavelengths();
  const ObserverWeights observer = observer_weights(to_observer(plan.observer()), wavelengths);
  const std::size_t bands = wavelengths.size();

  // Give each light its luminance, E[3.2-4], and multiply it by what the observer sees.
  BandTable sensors(3 * scene.lights.size(), bands);
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const RenderLight& light = scene.lights[i];
    const auto power =
        resample(scene.emissions[light.emission], wavelengths.nm(), Outside::zero).values;
    const double scale = luminance_scale(observer, power, light.luminance);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      std::vector<double> sensor = observer.weights[axis];
      for (std::size_t k = 0; k < bands; ++k) sensor[k] *= scale * power[k];
      sensors.set(3 * i + axis, sensor);
    }
  }

  FactorRows rows(scene);
  BandTable values(rows.size(), bands);
  rows.for_each(scene, wavelengths.nm(),
                [&](std::uint32_t row, const std::vector<double>& at) { values.set(row, at); });
  return std::make_unique<ExactMethod>(std::move(rows), std::move(values), std::move(sensors),
                                       scene.lights.size());
}

}  // namespace metamer
