#include "common/scene/check_wavelengths.h"

#include <algorithm>

#include "common/scene/limits.h"
#include "common/spectral/wavelengths.h"

namespace metamer {

bool check_wavelengths(const std::vector<double>& nm, const std::string& field,
                       Findings& findings) {
  const std::size_t before = findings.size();
  if (nm.size() > Wavelengths::max_count) {
    findings.add(indexed(field, Wavelengths::max_count),
                 "at most " + std::to_string(Wavelengths::max_count) +
                     " wavelengths can be used (there are " + std::to_string(nm.size()) + ")");
    return false;
  }
  for (std::size_t i = 0; i < nm.size(); ++i) {
    const std::string here = indexed(field, i);
    if (!(nm[i] >= limits::min_wavelength && nm[i] <= limits::max_wavelength)) {
      findings.add(here,
                   "wavelengths must lie in " + number_text(limits::min_wavelength) + ".." +
                       number_text(limits::max_wavelength) + " nm (it is " + number_text(nm[i]) +
                       ")",
                   nm[i], std::clamp(nm[i], limits::min_wavelength, limits::max_wavelength));
    } else if (i > 0 && nm[i] == nm[i - 1]) {
      findings.add(here, "wavelengths must not repeat (" + number_text(nm[i]) + " is there twice)");
    } else if (i > 0 && nm[i] < nm[i - 1]) {
      findings.add(here, "wavelengths must rise (" + number_text(nm[i]) + " comes after " +
                             number_text(nm[i - 1]) + ")");
    }
  }
  return findings.size() == before;
}

}  // namespace metamer
