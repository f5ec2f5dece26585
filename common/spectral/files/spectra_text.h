#pragma once

#include <string>
#include <vector>

#include "common/spectral/files/spectrum_file.h"

namespace metamer {

/// The formats that parse_spectra reads.
enum class SpectrumFormat { pairs, uniform, cgats };

/// The text of a file with these spectra (at least one), which parse_spectra reads back as the same
/// doubles; in CGATS with their names, in which a quote becomes ' and a control character ?.
/// Errors: several spectra in a plain format; unequal steps in `uniform`; several in `cgats` that
/// are not sampled alike.
/// CGATS says what they are (MEAS_TYPE); plain formats can't.
Result<std::string> spectra_text(const std::vector<NamedSpectrum>& spectra, SpectrumFormat format,
                                 std::optional<Quantity> quantity = {});

/// What straight lines between the samples of `resampled` make of the integral of `original`, which
/// outside its data is 0 or holds its end value.
struct EnergyCheck {
  double before = 0;   ///< ∫ original from the first new sample to the last.
  double after = 0;    ///< ∫ resampled.
  double outside = 0;  ///< ∫ original elsewhere: what the new range leaves out.
  /// The pair of neighbouring new samples (nm) between which the two differ most, after − before.
  double worst = 0, worst_from = 0, worst_to = 0;
};

EnergyCheck check_energy(const Spectrum& original, const Spectrum& resampled, Outside outside);

}  // namespace metamer
