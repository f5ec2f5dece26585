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

/// f64 takes more than twice as long as f32, from rows that are not in the first cache.
double ReferenceMethod::resolve_cost(const Gather& gather) const {
  if (costs::terms(gather) == 0) return 0;
  const double loop = 5 * costs::loop(bands_);
  return costs::terms(gather) * 2 * loop + costs::chains(gather) * 2 * loop + 3 * loop;
}

}  // namespace metamer
