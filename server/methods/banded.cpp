#include "server/methods/banded.h"

#include "common/transport/fold.h"
#include "server/methods/band_loops.h"
#include "server/methods/costs.h"

namespace metamer {

namespace {

/// The bands of a pixel's chains.
struct Carriers : Method::Scratch {
  std::vector<float> values;
};

}  // namespace

std::unique_ptr<Method::Scratch> BandedMethod::make_scratch() const {
  return std::make_unique<Carriers>();
}

BandedMethod::BandedMethod(FactorRows rows, Tables tables, double learned)
    : rows_(std::move(rows)), tables_(std::move(tables)), learned_(learned) {}

double BandedMethod::preparation_cost() const {
  return learned_ + costs::table(tables_.rows.rows(), tables_.rows.bands());
}

double BandedMethod::resolve_cost(const Gather& gather) const {
  return costs::terms(gather) * costs::loop(tables_.xyz.stride()) +
         costs::chains(gather) * 2 * costs::loop(tables_.xyz.stride()) +
         3 * costs::loop(tables_.xyz.stride());
}

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
      band_loops::add_lobes(n, carrier(chain), tables.lights.row(light), diffuse, specular, w);
    }
  }

  void term(std::uint32_t chain, std::uint32_t light, const FactorNode& factor, float weight) {
    band_loops::add_term(n, carrier(chain), tables.lights.row(light),
                         tables.rows.row(rows.row(factor)), weight);
  }

  void leave(std::uint32_t chain, std::uint32_t parent, const Factor& factor) {
    band_loops::add_over(n, carrier(parent), carrier(chain), tables.rows, rows.mix(factor));
  }
};

std::array<float, 3> BandedMethod::resolve(const Gather& gather, float scale,
                                           Scratch& scratch) const {
  const std::size_t n = tables_.xyz.stride();
  std::vector<float>& carriers = static_cast<Carriers&>(scratch).values;
  carriers.assign(gather.chains().size() * n, 0.0f);
  fold(gather, Fold{{}, rows_, tables_, n, carriers.data()});
  const float* seen = carriers.data();
  return {scale * band_loops::dot(n, seen, tables_.xyz.row(0)),
          scale * band_loops::dot(n, seen, tables_.xyz.row(1)),
          scale * band_loops::dot(n, seen, tables_.xyz.row(2))};
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
