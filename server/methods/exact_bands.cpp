#include "common/spectral/cells.h"
#include "common/transport/fold.h"
#include "server/methods/band_loops.h"
#include "server/methods/costs.h"
#include "server/methods/exact_tables.h"

namespace metamer {
namespace {

class ExactBands : public Method {
 public:
  ExactBands(ExactTables tables, BandTable powers, BandTable xyz)
      : tables_(std::move(tables)), powers_(std::move(powers)), xyz_(std::move(xyz)) {}

  struct Carriers : Scratch {
    std::vector<float> values;
  };
  std::unique_ptr<Scratch> make_scratch() const override { return std::make_unique<Carriers>(); }

  std::array<float, 3> resolve(const Gather& gather, float scale, Scratch& scratch) const override {
    std::vector<float>& carriers = static_cast<Carriers&>(scratch).values;
    const std::size_t chains = gather.chains().size();
    carriers.assign(chains > 1 ? chains * xyz_.stride() : 0, 0.0f);
    Fold carrier{{}, *this, carriers.data(), {}};
    fold(gather, carrier);
    std::array<float, 3> xyz = carrier.xyz;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      if (chains > 1) xyz[axis] += band_loops::dot(xyz_.stride(), carriers.data(), xyz_.row(axis));
      xyz[axis] *= scale;
    }
    return xyz;
  }

  DirectTables direct_tables() const override { return tables_.direct_tables(); }
  double preparation_cost() const override { return tables_.preparation_cost(); }
  double resolve_cost(const Gather& gather) const override {
    if (gather.chains().size() == 1) return costs::terms(gather) * 3;
    return (costs::terms(gather) + 2 * costs::chains(gather) + 3) * costs::loop(xyz_.stride());
  }

 private:
  struct Fold : FoldHooks {
    const ExactBands& method;
    float* carriers;
    std::array<float, 3> xyz;

    float* carrier(std::uint32_t chain) const { return carriers + chain * method.xyz_.stride(); }

    void lobes(std::uint32_t chain, std::uint32_t material, std::span<const LobeWeights> weights) {
      if (chain == 0) return lobes_as_terms(*this, chain, material, weights);
      const FactorRows& rows = method.tables_.rows;
      const BandTable& values = method.tables_.values;
      for (std::size_t light = 0; light < weights.size(); ++light)
        band_loops::add_lobes(method.xyz_.stride(), carrier(chain), method.powers_.row(light),
                              values.row(rows.diffuse(material)),
                              values.row(rows.specular(material)), weights[light]);
    }

    void term(std::uint32_t chain, std::uint32_t light, const FactorNode& factor, float weight) {
      const std::uint32_t row = method.tables_.rows.row(factor);
      if (chain > 0)
        return band_loops::add_term(method.xyz_.stride(), carrier(chain), method.powers_.row(light),
                                    method.tables_.values.row(row), weight);
      const float* color = method.tables_.direct_color(row) + 3 * light;
      for (std::size_t axis = 0; axis < 3; ++axis) xyz[axis] += weight * color[axis];
    }

    void leave(std::uint32_t chain, std::uint32_t parent, const Factor& factor) {
      band_loops::add_over(method.xyz_.stride(), carrier(parent), carrier(chain),
                           method.tables_.values, method.tables_.rows.mix(factor));
    }
  };

  ExactTables tables_;
  BandTable powers_;  ///< A row a light.
  BandTable xyz_;     ///< Three rows.
};

}  // namespace

std::unique_ptr<Method> make_exact_bands(ExactTables tables, const RenderScene& scene,
                                         const Observer& observer) {
  const std::vector<double>& nm = tables.nm;
  const std::vector<double> nothing(nm.size());
  BandTable powers(scene.lights.size(), nm.size()), xyz(3, nm.size());
  std::vector<double> power_of_all = nothing;
  std::array<std::vector<double>, 3> seen_of_all = {nothing, nothing, nothing};
  for (std::size_t i = 0; i < scene.lights.size(); ++i) {
    const Spectrum& emission = scene.emissions[scene.lights[i].emission];
    const double y = emission_xyz(emission, observer)[1];
    std::vector<double> power = light_shares(emission, nm);
    for (double& value : power) value *= y > 0 ? scene.lights[i].luminance / y : 0;
    powers.set(i, power);
    for (std::size_t k = 0; k < nm.size(); ++k) {
      power_of_all[k] += power[k];
      for (std::size_t axis = 0; axis < 3; ++axis)
        seen_of_all[axis][k] += double{tables.sensors.row(3 * i + axis)[k]};
    }
  }

  // What a band is seen as: a mean by the power of the lights within it, so that of one light the
  // sums are those of its sensors.
  const auto& functions = observer.functions();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    std::vector<double> weights = resample(functions[axis], nm, Outside::zero).values;
    for (std::size_t k = 0; k < nm.size(); ++k)
      if (power_of_all[k] > 0) weights[k] = seen_of_all[axis][k] / power_of_all[k];
    xyz.set(axis, weights);
  }
  return std::make_unique<ExactBands>(std::move(tables), std::move(powers), std::move(xyz));
}

}  // namespace metamer
