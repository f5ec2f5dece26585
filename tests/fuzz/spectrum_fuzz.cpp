// The readers of spectrum files against any bytes.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "check.h"
#include "common/spectral/files/bispectral_file.h"
#include "common/spectral/files/interpret.h"
#include "common/spectral/files/spectra_text.h"

namespace {

using metamer::fuzz::check;

void check_spectrum(const metamer::Spectrum& spectrum) {
  check(!spectrum.nm.empty() && spectrum.nm.size() == spectrum.values.size(),
        "a spectrum has as many values as wavelengths");
  check(!metamer::wrong_positions(spectrum.nm), "wavelengths rise");
  check(std::all_of(spectrum.values.begin(), spectrum.values.end(),
                    [](double value) { return std::isfinite(value); }),
        "values are finite");
}

void check_file(const metamer::SpectrumFile& file) {
  check(!file.format.empty() && !file.spectra.empty(), "a file has a format and spectra");
  check(file.spectra.size() <= metamer::max_spectra, "spectra are bounded");
  for (const metamer::NamedSpectrum& named : file.spectra) {
    check_spectrum(named.spectrum);
    for (const auto use : {metamer::Use::any, metamer::Use::emission, metamer::Use::property})
      for (const bool clamp : {false, true})
        if (const auto taken = metamer::interpret(file, named.spectrum, {.clamp = clamp}, use)) {
          check_spectrum(taken->spectrum);
          if (use == metamer::Use::property)
            check(std::all_of(taken->spectrum.values.begin(), taken->spectrum.values.end(),
                              [](double value) { return value >= 0 && value <= 1; }),
                  "a property lies in 0..1");
        }
  }

  // What was read is written and read again as the same.
  const auto text = metamer::spectra_text({file.spectra.front()}, metamer::SpectrumFormat::cgats);
  check(text.has_value(), "a spectrum can be written");
  const auto again = metamer::parse_spectra(*text, "again.sp");
  check(again && again->front().spectrum == file.spectra.front().spectrum,
        "a spectrum is written and read as the same");
}

void check_matrix(std::string_view bytes) {
  const auto matrix = metamer::read_bispectral_file(bytes, "fuzz.csv");
  if (!matrix) return check(!matrix.error().message.empty(), "a problem says something");
  check(
      !metamer::wrong_positions(matrix->excitation) && !metamer::wrong_positions(matrix->emission),
      "a matrix's wavelengths rise");
  check(matrix->values.size() == matrix->excitation.size() * matrix->emission.size() &&
            matrix->values.size() <= metamer::max_bispectral_cells,
        "a matrix is whole and bounded");
  check(std::all_of(matrix->values.begin(), matrix->values.end(),
                    [](double value) { return value >= 0 && std::isfinite(value); }),
        "a matrix is finite and not negative");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  check_matrix(bytes);
  const auto file = metamer::read_spectrum_file(bytes, "fuzz.txt");
  if (file) {
    check_file(*file);
    return 0;
  }
  check(!file.error().message.empty(), "a problem says something");
  check(file.error().line >= 0 && file.error().column >= 0, "a place counts from 1");
  return 0;
}
