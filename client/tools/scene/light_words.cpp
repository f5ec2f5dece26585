#include "client/tools/scene/light_words.h"

#include "client/tools/spectra/picture_spectra.h"
#include "client/tools/spectra/spectra_files.h"
#include "client/tools/spectra/spectrum_word.h"
#include "common/color/illuminants.h"
#include "common/scene/reading.h"

namespace metamer::client {
namespace {

v1::Spectrum::Interpolation message_of(Interpolation interpolation) {
  switch (interpolation) {
    case Interpolation::linear:
      return v1::Spectrum::LINEAR;
    case Interpolation::sprague:
      return v1::Spectrum::SPRAGUE;
    case Interpolation::monotone_cubic:
      return v1::Spectrum::MONOTONE_CUBIC;
  }
  return v1::Spectrum::RECOMMENDED;
}

}  // namespace

Result<WordLight> light_of_word(const std::string& word) {
  auto parsed = parse_spectrum_word(word);
  if (!parsed) return tl::unexpected(std::move(parsed.error()));
  WordLight light;
  if (!parsed->is_file) {
    if (word.find_first_of("./#") != std::string::npos && !names_formula(word))
      return problem("there is no file " + metamer::quoted(parsed->name));
    light.spectrum.set_standard(word);
    return light;
  }
  if (is_picture_of_spectra(parsed->name)) {
    const auto loaded = load_one(word, {.use = Use::emission});
    if (!loaded) return tl::unexpected(loaded.error().problem);
    const Spectrum& spectrum = loaded->spectrum();
    auto& samples = *light.spectrum.mutable_samples();
    samples.mutable_wavelength()->Assign(spectrum.nm.begin(), spectrum.nm.end());
    samples.mutable_value()->Assign(spectrum.values.begin(), spectrum.values.end());
    light.spectrum.set_interpolation(v1::Spectrum::LINEAR);
    return light;
  }
  light.file = parsed->name;
  light.spectrum.set_file(parsed->name);
  if (parsed->entry) light.spectrum.set_entry(*parsed->entry);
  if (parsed->interpolation) light.spectrum.set_interpolation(message_of(*parsed->interpolation));
  *light.spectrum.mutable_reading() = to_message(parsed->reading);
  return light;
}

}  // namespace metamer::client
