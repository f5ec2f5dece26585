#include "server/plan/reference_method.h"

#include "server/methods/banded.h"
#include "server/methods/costs.h"
#include "server/methods/point.h"

namespace metamer {

/// A reference belongs to one thread.
struct ReferenceMethod::Own : Scratch {
  Reference reference;
  Own(const RenderScene& scene, const Observer& observer) : reference(scene, observer) {}
};

ReferenceMethod::ReferenceMethod(const RenderScene& scene, const Observer& observer)
    : scene_(scene),
      observer_(observer),
      bands_(Reference::cells(scene, observer).size()),
      rows_(FactorRows(scene).size()) {}

ReferenceMethod::~ReferenceMethod() = default;

std::unique_ptr<Method::Scratch> ReferenceMethod::make_scratch() const {
  return std::make_unique<Own>(scene_, observer_);
}

std::array<float, 3> ReferenceMethod::resolve(const Gather& gather, float scale,
                                              Scratch& scratch) const {
  const Xyz xyz = static_cast<Own&>(scratch).reference.resolve(gather, double{scale});
  return {static_cast<float>(xyz[0]), static_cast<float>(xyz[1]), static_cast<float>(xyz[2])};
}

DirectTables ReferenceMethod::direct_tables() const {
  return make_sampled(Reference::cells(scene_, observer_), observer_, scene_)->direct_tables();
}

double ReferenceMethod::preparation_cost() const { return costs::table(rows_, bands_); }

/// In f64, and from rows beyond the first cache: measured over 940 to 7,982 bands, ns a value.
double ReferenceMethod::resolve_cost(const Gather& gather) const {
  if (gather.is_dark()) return 0;
  constexpr double lobe = 0.33, chain = 0.83, sums = 0.75;
  double lobes = static_cast<double>(gather.terms().size());
  for (std::size_t s = 0; s < gather.surfaces().size(); ++s)
    for (const LobeWeights& w : gather.weights(s))
      lobes += (w.diffuse != 0) + (w.specular != 0) + (w.white != 0);
  return static_cast<double>(bands_) * (lobe * lobes + chain * costs::chains(gather) + sums);
}

}  // namespace metamer
