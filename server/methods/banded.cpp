#include "server/methods/banded.h"

#include <algorithm>
#include <cassert>

namespace metamer {
namespace {

constexpr std::size_t pad = 16;

/// Loops over `n` bands, n a multiple of 16, of rows that do not overlap.
using Row = float* __restrict;
using ConstRow = const float* __restrict;

void add_diffuse(std::size_t n, Row carrier, ConstRow light, ConstRow diffuse, float d) {
  for (std::size_t i = 0; i < n; ++i) carrier[i] += light[i] * (d * diffuse[i]);
}

void add_lobes(std::size_t n, Row carrier, ConstRow light, ConstRow diffuse, ConstRow specular,
               const LobeWeights& w) {
  for (std::size_t i = 0; i < n; ++i)
    carrier[i] += light[i] * (w.diffuse * diffuse[i] + (w.specular * specular[i] + w.white));
}

void add_reflected(std::size_t n, Row carrier, ConstRow incoming, ConstRow specular) {
  for (std::size_t i = 0; i < n; ++i) carrier[i] += incoming[i] * specular[i];
}

/// A dot product in 16 partial sums: vectorised whatever the compiler may assume of addition, and
/// more exact than one running sum.
float dot(std::size_t n, ConstRow a, ConstRow b) {
  float sums[pad] = {};
  for (std::size_t i = 0; i < n; i += pad)
    for (std::size_t j = 0; j < pad; ++j) sums[j] += a[i + j] * b[i + j];
  for (std::size_t width = pad / 2; width > 0; width /= 2)
    for (std::size_t j = 0; j < width; ++j) sums[j] += sums[j + width];
  return sums[0];
}

}  // namespace

BandTable::BandTable(std::size_t rows, std::size_t bands)
    : stride_((bands + pad - 1) / pad * pad),
      values_(new (std::align_val_t{64}) float[std::max<std::size_t>(rows, 1) * stride_]()) {}

void BandTable::set(std::size_t index, const std::vector<double>& values) {
  assert(values.size() <= stride_);
  std::transform(values.begin(), values.end(), row(index),
                 [](double value) { return static_cast<float>(value); });
}

BandedMethod::BandedMethod(BandTable lights, BandTable properties, BandTable xyz,
                           const std::vector<RenderMaterial>& materials)
    : lights_(std::move(lights)), properties_(std::move(properties)), xyz_(std::move(xyz)) {
  for (const RenderMaterial& material : materials)
    materials_.push_back({material.diffuse, material.specular});
}

std::array<float, 3> BandedMethod::resolve(const Gather& gather, float scale,
                                           Scratch& scratch) const {
  const std::size_t n = xyz_.stride();
  const auto paths = gather.paths();
  scratch.assign(paths.size() * n, 0.0f);
  const auto carrier = [&](std::size_t path) { return scratch.data() + path * n; };

  // Reflect each light by each surface, at the end of the surface's path.
  const auto surfaces = gather.surfaces();
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    const Spectra& spectra = materials_[surfaces[s].material];
    const float* diffuse = properties_.row(spectra.diffuse);
    const float* specular = properties_.row(spectra.specular);
    const auto weights = gather.weights(s);
    for (std::size_t light = 0; light < weights.size(); ++light) {
      const LobeWeights& w = weights[light];
      if (w.specular != 0 || w.white != 0)
        add_lobes(n, carrier(surfaces[s].path), lights_.row(light), diffuse, specular, w);
      else if (w.diffuse != 0)
        add_diffuse(n, carrier(surfaces[s].path), lights_.row(light), diffuse, w.diffuse);
    }
  }

  // Carry the light back over the mirrors, the longest paths first.
  for (std::size_t path = paths.size(); path-- > 1;)
    add_reflected(n, carrier(paths[path].parent), carrier(path),
                  properties_.row(materials_[paths[path].material].specular));

  // Integrate what reaches the eye.
  return {scale * dot(n, carrier(0), xyz_.row(0)), scale * dot(n, carrier(0), xyz_.row(1)),
          scale * dot(n, carrier(0), xyz_.row(2))};
}

}  // namespace metamer
