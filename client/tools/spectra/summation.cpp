#include "client/tools/spectra/summation.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace metamer::client {

Wavelengths own_wavelengths(const Spectrum& light) {
  const auto& nm = light.nm;
  double widest = nm.size() > 1 ? 0 : 1000;
  for (std::size_t i = 1; i < nm.size(); ++i) widest = std::max(widest, nm[i] - nm[i - 1]);
  return widest <= 5 ? *Wavelengths::listed(nm) : fine_wavelengths(light);
}

Wavelengths fine_wavelengths(const Spectrum& light) {
  const Wavelengths by_1_nm = observer_wavelengths();
  std::vector<double> own, both = by_1_nm.nm();
  for (const double nm : light.nm)
    if (nm > observer_from_nm && nm < observer_to_nm) own.push_back(nm);
  both.insert(both.end(), own.begin(), own.end());
  std::sort(both.begin(), both.end());
  both.erase(std::unique(both.begin(), both.end()), both.end());
  if (both.size() <= Wavelengths::max_count) return *Wavelengths::listed(std::move(both));
  return *Wavelengths::listed(std::move(own));
}

}  // namespace metamer::client
