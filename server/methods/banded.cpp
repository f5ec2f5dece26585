#include "server/methods/banded.h"

#include <algorithm>
#include <cassert>

#include "common/transport/fold.h"

namespace metamer {
namespace {

/// Loops over `n` bands, n a multiple of 16, of rows that do not overlap.
using Row = float* __restrict;
using ConstRow = const float* __restrict;

void add_term(std::size_t n, Row carrier, ConstRow light, ConstRow row, float weight) {
  for (std::size_t i = 0; i < n; ++i) carrier[i] += light[i] * (weight * row[i]);
}

void add_lobes(std::size_t n, Row carrier, ConstRow light, ConstRow diffuse, ConstRow specular,
               const LobeWeights& w) {
  for (std::size_t i = 0; i < n; ++i)
    carrier[i] += light[i] * (w.diffuse * diffuse[i] + (w.specular * specular[i] + w.white));
}

/// Over a factor that is one row, or a weighted sum of two.
void add_product(std::size_t n, Row carrier, ConstRow incoming, ConstRow row) {
  for (std::size_t i = 0; i < n; ++i) carrier[i] += incoming[i] * row[i];
}

void add_product(std::size_t n, Row carrier, ConstRow incoming, ConstRow first, float w,
                 ConstRow second, float v) {
  for (std::size_t i = 0; i < n; ++i) carrier[i] += incoming[i] * (w * first[i] + v * second[i]);
}

/// A dot product in 16 partial sums: vectorised whatever the compiler may assume of addition, and
/// more exact than one running sum.
float dot(std::size_t n, ConstRow a, ConstRow b) {
  float sums[band_pad] = {};
  for (std::size_t i = 0; i < n; i += band_pad)
    for (std::size_t j = 0; j < band_pad; ++j) sums[j] += a[i + j] * b[i + j];
  for (std::size_t width = band_pad / 2; width > 0; width /= 2)
    for (std::size_t j = 0; j < width; ++j) sums[j] += sums[j + width];
  return sums[0];
}

}  // namespace

BandTable::BandTable(std::size_t rows, std::size_t bands)
    : rows_(rows),
      bands_(bands),
      stride_((bands + band_pad - 1) / band_pad * band_pad),
      values_(new (std::align_val_t{64}) float[std::max<std::size_t>(rows, 1) * stride_]()) {}

void BandTable::set(std::size_t index, const std::vector<double>& values) {
  assert(values.size() <= stride_);
  std::transform(values.begin(), values.end(), row(index),
                 [](double value) { return static_cast<float>(value); });
}

std::vector<float> BandTable::packed() const {
  const std::size_t width = 4 * std::size_t{groups_of_four(bands_)};
  std::vector<float> all(rows_ * width);
  for (std::size_t i = 0; i < rows_; ++i) std::copy_n(row(i), bands_, &all[i * width]);
  return all;
}

namespace {

/// The bands of a pixel's chains.
struct Carriers : Method::Scratch {
  std::vector<float> values;
};

}  // namespace

std::unique_ptr<Method::Scratch> BandedMethod::make_scratch() const {
  return std::make_unique<Carriers>();
}

BandedMethod::BandedMethod(FactorRows rows, Tables tables)
    : rows_(std::move(rows)), tables_(std::move(tables)) {}

/// Reflects each light at the end of a chain, and carries it back to the eye.
struct BandedMethod::Fold : FoldHooks {
  const FactorRows& rows;
  const Tables& tables;
  std::size_t n;
  float* carriers;

  float* carrier(std::uint32_t chain) const { return carriers + chain * n; }

  void lobes(std::uint32_t chain, std::uint32_t material, std::span<const LobeWeights> weights) {
    const float* diffuse = tables.rows.row(rows.diffuse(material));
    const float* specular = tables.rows.row(rows.specular(material));
    for (std::size_t light = 0; light < weights.size(); ++light) {
      const LobeWeights& w = weights[light];
      if (w.specular != 0 || w.white != 0)
        add_lobes(n, carrier(chain), tables.lights.row(light), diffuse, specular, w);
      else if (w.diffuse != 0)
        add_term(n, carrier(chain), tables.lights.row(light), diffuse, w.diffuse);
    }
  }

  void term(std::uint32_t chain, std::uint32_t light, const FactorNode& factor, float weight) {
    add_term(n, carrier(chain), tables.lights.row(light), tables.rows.row(rows.row(factor)),
             weight);
  }

  void leave(std::uint32_t chain, std::uint32_t parent, const Factor& factor) {
    const FactorRows::Mix mix = rows.mix(factor);
    const float* first = tables.rows.row(mix.row[0]);
    if (mix.count == 1)
      add_product(n, carrier(parent), carrier(chain), first);
    else
      add_product(n, carrier(parent), carrier(chain), first, mix.weight[0],
                  tables.rows.row(mix.row[1]), mix.weight[1]);
  }
};

std::array<float, 3> BandedMethod::resolve(const Gather& gather, float scale,
                                           Scratch& scratch) const {
  const std::size_t n = tables_.xyz.stride();
  std::vector<float>& carriers = static_cast<Carriers&>(scratch).values;
  carriers.assign(gather.chains().size() * n, 0.0f);
  fold(gather, Fold{{}, rows_, tables_, n, carriers.data()});
  const float* seen = carriers.data();
  return {scale * dot(n, seen, tables_.xyz.row(0)), scale * dot(n, seen, tables_.xyz.row(1)),
          scale * dot(n, seen, tables_.xyz.row(2))};
}

DirectTables BandedMethod::direct_tables() const {
  const std::size_t lights = tables_.lights.rows(), bands = tables_.xyz.bands();
  BandTable sensors(3 * lights, bands);
  for (std::size_t light = 0; light < lights; ++light)
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (std::size_t i = 0; i < bands; ++i)
        sensors.row(3 * light + axis)[i] = tables_.lights.row(light)[i] * tables_.xyz.row(axis)[i];
  const std::uint32_t size = groups_of_four(bands);
  return {.size = size,
          .row_stride = size,
          .light_stride = 0,
          .sensor_stride = 3 * size,
          .values = tables_.rows.packed(),
          .sensors = sensors.packed(),
          .lights = tables_.lights.packed(),
          .observer = tables_.xyz.packed()};
}

}  // namespace metamer
