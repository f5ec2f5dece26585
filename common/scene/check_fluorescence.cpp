#include "common/scene/check_spectrum.h"
#include "common/scene/parts.h"

namespace metamer {

void check_fluorescence(const v1::Fluorescence& fluorescence, const std::string& field,
                        Findings& findings) {
  const bool spectra = fluorescence.has_excitation() || fluorescence.has_emission() ||
                       fluorescence.has_quantum_yield();
  if (!fluorescence.file().empty()) {
    if (spectra)
      findings.add(field,
                   "fluorescence takes either a file or excitation, emission and "
                   "quantum_yield, not both");
    return;
  }
  if (!fluorescence.has_excitation() || !fluorescence.has_emission() ||
      !fluorescence.has_quantum_yield())
    return findings.add(field,
                        "fluorescence needs a file, or excitation, emission and "
                        "quantum_yield");
  check_spectrum(fluorescence.excitation(), field + ".excitation", SpectrumRole::excitation,
                 findings);
  check_spectrum(fluorescence.emission(), field + ".emission", SpectrumRole::emission, findings);
  if (fluorescence.emission().source_case() == v1::Spectrum::kConstant)
    findings.add(field + ".emission.constant",
                 "an emission of a fluorescence needs wavelengths: samples or a file");
  check_range(fluorescence.quantum_yield(), 0, 1, field + ".quantum_yield", findings);
}

}  // namespace metamer
