#include "client/tools/scene/light_words.h"

#include "client/tools/spectra/spectra_files.h"
#include "client/tools/spectra/spectrum_word.h"
#include "common/color/illuminants.h"
#include "common/image/pixel_spectrum.h"
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

v1::Spectrum sampled(const Spectrum& spectrum, Interpolation interpolation) {
  v1::Spectrum message;
  auto& samples = *message.mutable_samples();
  samples.mutable_wavelength()->Assign(spectrum.nm.begin(), spectrum.nm.end());
  samples.mutable_value()->Assign(spectrum.values.begin(), spectrum.values.end());
  message.set_interpolation(message_of(interpolation));
  return message;
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
    light.spectrum = sampled(loaded->spectrum(), Interpolation::linear);
    return light;
  }
  light.file = parsed->name;
  light.spectrum.set_file(parsed->name);
  if (parsed->entry) light.spectrum.set_entry(*parsed->entry);
  if (parsed->interpolation) light.spectrum.set_interpolation(message_of(*parsed->interpolation));
  *light.spectrum.mutable_reading() = to_message(parsed->reading);
  return light;
}

namespace {

/// Of a file in the folder, else by the word itself.
Result<LoadedSpectrum> load_from(const std::filesystem::path& folder, const std::string& word,
                                 Use use) {
  const std::string inside = (folder / word).string();
  const auto there = parse_spectrum_word(inside);
  auto loaded = load_one(there && there->is_file ? inside : word, {.use = use});
  if (!loaded) return tl::unexpected(std::move(loaded.error().problem));
  return std::move(*loaded);
}

}  // namespace

Result<SpectrumRole> role_of_word(const std::string& word, const std::filesystem::path& folder) {
  return load_from(folder, word, Use::any).map([](const LoadedSpectrum& loaded) {
    return loaded.emission() ? SpectrumRole::emission : SpectrumRole::property;
  });
}

Result<v1::Spectrum> embedded_spectrum(const std::string& word, SpectrumRole role,
                                       const std::filesystem::path& folder) {
  const bool emission = role == SpectrumRole::emission;
  const auto loaded = load_from(folder, word, emission ? Use::emission : Use::property);
  if (!loaded) return tl::unexpected(loaded.error());
  if (emission && !loaded->emission())
    return problem(metamer::quoted(word) + " is a reflectance, no light");
  if (!emission && loaded->computed && loaded->emission())
    return problem(metamer::quoted(word) + " is a light, no paint");
  const std::string fault =
      emission ? emission_fault(loaded->spectrum()) : reflectance_fault(loaded->spectrum());
  if (!fault.empty()) return problem(metamer::quoted(word) + ": " + fault);
  if (emission && loaded->computed) {
    v1::Spectrum named;
    named.set_standard(word);
    return named;
  }
  return sampled(loaded->samples, loaded->curve.interpolation);
}

}  // namespace metamer::client
