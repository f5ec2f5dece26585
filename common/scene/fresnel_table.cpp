#include "common/scene/fresnel_table.h"

#include "common/models/reference.h"

namespace metamer {

ConstantsAt resample(const OpticalConstants& constants, const std::vector<double>& nm) {
  ConstantsAt result{resample(constants.n, nm, Outside::hold).values, {}};
  if (!constants.k.nm.empty()) result.k = resample(constants.k, nm, Outside::hold).values;
  return result;
}

std::vector<double> fresnel_at(const ConstantsAt& constants, double cosine) {
  std::vector<double> values(constants.n.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    values[i] = constants.k.empty()
                    ? models::dielectric_fresnel(cosine, constants.n[i])
                    : models::conductor_fresnel(cosine, constants.n[i], constants.k[i]);
  return values;
}

}  // namespace metamer
