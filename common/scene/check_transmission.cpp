#include "common/scene/check_spectrum.h"
#include "common/scene/limits.h"
#include "common/scene/parts.h"

namespace metamer {

void check_transmission(const v1::Material& material, const std::string& field,
                        Findings& findings) {
  const v1::Transmission& transmission = material.transmission();
  if (transmission.has_transmittance())
    check_spectrum(transmission.transmittance(), field + ".transmittance", SpectrumRole::property,
                   findings);
  if (transmission.has_thickness()) {
    check_range(transmission.thickness(), limits::min_thickness, limits::max_thickness,
                field + ".thickness", findings);
    if (!transmission.has_transmittance())
      findings.add(field + ".thickness",
                   "thickness is that of a transmittance, which is not given");
  }
  check_range(transmission.priority(), -limits::max_priority, limits::max_priority,
              field + ".priority", findings);
  if (!material.fresnel().has_dielectric())
    findings.add(field,
                 "transmission needs the material's index of refraction: fresnel { "
                 "dielectric { medium: \"N-BK7\" } }, for example");
  if (material.mirror() > 0)
    findings.add(field, "transmission reflects by its Fresnel term already: leave out mirror");
}

}  // namespace metamer
