#include "server/methods/exact.h"

#include <algorithm>
#include <numeric>

#include "common/transport/fold.h"
#include "server/methods/band_loops.h"
#include "server/methods/costs.h"
#include "server/methods/exact_tables.h"

namespace metamer {
namespace {

class Exact : public Method {
 public:
  explicit Exact(ExactTables tables) : tables_(std::move(tables)) {}

  struct Carriers : Scratch {
    explicit Carriers(const ExactTables& tables)
        : sensors(tables), by_emission(tables.emissions()) {}
    std::vector<float> values;
    std::vector<char> is_filled;  ///< By chain: some light is in its bands.
    MetSensors sensors;
    std::vector<LobeWeights> by_emission;
  };
  std::unique_ptr<Scratch> make_scratch() const override {
    return std::make_unique<Carriers>(tables_);
  }

  std::array<float, 3> resolve(const Gather& gather, float scale, Scratch& scratch) const override {
    auto& carriers = static_cast<Carriers&>(scratch);
    const std::size_t chains = gather.chains().size();
    if (chains > 1 && carriers.values.size() < chains * stride())
      carriers.values.resize(chains * stride());
    carriers.is_filled.assign(chains, false);
    carriers.sensors.bound();
    Fold carrier{{}, *this, carriers, {}};
    fold(gather, carrier);
    const auto& first = tables_.bands.bands().first;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const float* seen = carriers.values.data();
      if (carriers.is_filled[0])
        carrier.xyz[axis] =
            std::accumulate(seen + first[axis], seen + first[axis + 1], carrier.xyz[axis]);
      carrier.xyz[axis] *= scale;
    }
    return carrier.xyz;
  }

  DirectTables direct_tables() const override { return tables_.direct_tables(); }
  double preparation_cost() const override { return tables_.preparation_cost(); }
  double resolve_cost(const Gather& gather) const override {
    if (gather.chains().size() == 1) return costs::terms(gather) * 3;
    // Of a surface's lights, a loop for each spectrum.
    const std::size_t loops =
        gather.surfaces().size() * tables_.emissions() + gather.terms().size();
    return costs::terms(gather) * 3 +
           (static_cast<double>(loops) + 2 * costs::chains(gather) + 1) * costs::loop(stride());
  }

 private:
  struct Fold : FoldHooks {
    const Exact& method;
    Carriers& carriers;
    std::array<float, 3> xyz;

    float* carrier(std::uint32_t chain) const {
      float* values = carriers.values.data() + chain * method.stride();
      if (!carriers.is_filled[chain]) std::fill_n(values, method.stride(), 0.0f);
      carriers.is_filled[chain] = true;
      return values;
    }

    void lobes(std::uint32_t chain, std::uint32_t material, std::span<const LobeWeights> weights) {
      if (chain == 0) return lobes_as_terms(*this, chain, material, weights);
      // Lights of one spectrum are one.
      std::vector<LobeWeights>& sums = carriers.by_emission;
      sums.assign(sums.size(), {});
      LobeWeights all;
      for (std::size_t i = 0; i < weights.size(); ++i) {
        const ExactTables::Light& light = method.tables_.lights[i];
        for (LobeWeights* to : {&sums[light.emission], &all}) {
          to->diffuse += light.luminance * weights[i].diffuse;
          to->specular += light.luminance * weights[i].specular;
          to->white += light.luminance * weights[i].white;
        }
      }

      const FactorRows& rows = method.tables_.rows;
      const auto sensors = [&](float weight, std::uint32_t row) {
        return weight != 0 ? &carriers.sensors(row) : nullptr;
      };
      const BandTable& white = carriers.sensors(FactorRows::white);
      const BandTable* diffuse = sensors(all.diffuse, rows.diffuse(material));
      const BandTable* specular = sensors(all.specular, rows.specular(material));
      for (std::size_t i = 0; i < sums.size(); ++i)
        if (sums[i].diffuse != 0 || sums[i].specular != 0 || sums[i].white != 0)
          band_loops::add_sensors(method.stride(), carrier(chain),
                                  (diffuse ? *diffuse : white).row(i),
                                  (specular ? *specular : white).row(i), white.row(i), sums[i]);
    }

    void term(std::uint32_t chain, std::uint32_t light, const FactorNode& factor, float weight) {
      const std::uint32_t row = method.tables_.rows.row(factor);
      if (chain > 0) {
        const ExactTables::Light& from = method.tables_.lights[light];
        const BandTable& sensors = carriers.sensors(row);
        const LobeWeights w{from.luminance * weight, 0, 0};
        const float* sensor = sensors.row(from.emission);
        return band_loops::add_sensors(method.stride(), carrier(chain), sensor, sensor, sensor, w);
      }
      const float* color = method.tables_.direct_color(row) + 3 * light;
      for (std::size_t axis = 0; axis < 3; ++axis) xyz[axis] += weight * color[axis];
    }

    void leave(std::uint32_t chain, std::uint32_t parent, const Factor& factor) {
      if (!carriers.is_filled[chain]) return;
      band_loops::add_over(method.stride(), carrier(parent), carrier(chain), method.tables_.values,
                           method.tables_.rows.mix(factor));
    }
  };

  std::size_t stride() const { return tables_.values.stride(); }

  ExactTables tables_;
};

}  // namespace

std::uint64_t direct_signatures(const RenderScene& scene) {
  return std::uint64_t{FactorRows(scene).size()} * scene.lights.size();
}

void plan_exact(const RenderScene& scene, const v1::Settings&, v1::Plan& plan) {
  plan.set_signatures(direct_signatures(scene));
}

std::unique_ptr<Method> make_exact(const v1::Plan& plan, const RenderScene& scene) {
  return std::make_unique<Exact>(ExactTables(scene, scene.observer, plan.depth(), plan.bounces()));
}

}  // namespace metamer
