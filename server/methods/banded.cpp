#include "server/methods/banded.h"

#include <algorithm>
#include <cassert>

#include "server/methods/fresnel_table.h"
#include "server/models/lanes.h"

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

/// Through Schlick's Fresnel term, E[2.2-12]: f + (1 − f) rise.
void add_schlick(std::size_t n, Row carrier, ConstRow incoming, ConstRow specular, float rise) {
  for (std::size_t i = 0; i < n; ++i)
    carrier[i] += incoming[i] * (specular[i] + (1 - specular[i]) * rise);
}

/// Through a Fresnel term `fraction` of the way between two nodes.
void add_between(std::size_t n, Row carrier, ConstRow incoming, ConstRow below, ConstRow above,
                 float fraction) {
  for (std::size_t i = 0; i < n; ++i)
    carrier[i] += incoming[i] * (below[i] + fraction * (above[i] - below[i]));
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

BandedMethod::BandedMethod(Tables tables, const std::vector<RenderMaterial>& materials)
    : tables_(std::move(tables)) {
  for (const RenderMaterial& material : materials)
    materials_.push_back({material.fresnel, material.diffuse, material.specular,
                          material.constants * fresnel_nodes});
}

/// Adds what one surface reflects of each light.
void BandedMethod::reflect(const Gather& gather, std::size_t surface, float* carrier) const {
  const std::size_t n = tables_.xyz.stride();
  const Spectra& spectra = materials_[gather.surfaces()[surface].material];
  const float* diffuse = tables_.properties.row(spectra.diffuse);
  const float* specular = tables_.properties.row(spectra.specular);
  const auto weights = gather.weights(surface);
  for (std::size_t light = 0; light < weights.size(); ++light) {
    const LobeWeights& w = weights[light];
    if (w.specular != 0 || w.white != 0)
      add_lobes(n, carrier, tables_.lights.row(light), diffuse, specular, w);
    else if (w.diffuse != 0)
      add_diffuse(n, carrier, tables_.lights.row(light), diffuse, w.diffuse);
  }
}

/// Adds what the last mirror of `path` reflects.
void BandedMethod::add_mirror(const Gather::Path& path, const float* from, float* to) const {
  const std::size_t n = tables_.xyz.stride();
  const Spectra& spectra = materials_[path.material];
  switch (spectra.fresnel) {
    case FresnelKind::none:
      add_reflected(n, to, from, tables_.properties.row(spectra.specular));
      break;
    case FresnelKind::schlick:
      add_schlick(n, to, from, tables_.properties.row(spectra.specular),
                  models::schlick_rise(path.cosine));
      break;
    case FresnelKind::exact: {
      const FresnelPlace place = fresnel_place(path.cosine);
      const float* below = tables_.fresnel.row(spectra.first_node + place.below);
      add_between(n, to, from, below, below + n, place.fraction);
      break;
    }
  }
}

std::array<float, 3> BandedMethod::resolve(const Gather& gather, float scale,
                                           Scratch& scratch) const {
  const std::size_t n = tables_.xyz.stride();
  const auto paths = gather.paths();
  scratch.assign(paths.size() * n, 0.0f);
  const auto carrier = [&](std::size_t path) { return scratch.data() + path * n; };

  // Reflect each light by each surface, at the end of the surface's path.
  const auto surfaces = gather.surfaces();
  for (std::size_t s = 0; s < surfaces.size(); ++s) reflect(gather, s, carrier(surfaces[s].path));
  for (const Gather::FresnelWeight& one : gather.fresnel()) {
    const Gather::Surface& surface = surfaces[one.surface];
    add_diffuse(n, carrier(surface.path), tables_.lights.row(one.light),
                tables_.fresnel.row(materials_[surface.material].first_node + one.node),
                one.weight);
  }

  // Carry the light back over the mirrors, the longest paths first.
  for (std::size_t path = paths.size(); path-- > 1;)
    add_mirror(paths[path], carrier(path), carrier(paths[path].parent));

  // Integrate what reaches the eye.
  return {scale * dot(n, carrier(0), tables_.xyz.row(0)),
          scale * dot(n, carrier(0), tables_.xyz.row(1)),
          scale * dot(n, carrier(0), tables_.xyz.row(2))};
}

}  // namespace metamer
