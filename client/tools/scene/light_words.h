#pragma once

#include <filesystem>
#include <string>

#include "common/problem.h"
#include "common/scene/validate.h"
#include "metamer/v1/scene.pb.h"

namespace metamer::client {

/// A light's spectrum as a scene has it, by a word of the command line.
struct WordLight {
  v1::Spectrum spectrum;
  std::filesystem::path file = {};  ///< Where spectrum.file lies, as seen from here; empty: none.
};

/// As parse_spectrum_word takes words; what is no file is an illuminant's name. A pixel of a
/// picture becomes samples. Errors: those of parse_spectrum_word; a name with "." or "/" of what is
/// neither.
Result<WordLight> light_of_word(const std::string& word);

/// A light's or a paint's spectrum as a scene has it without a file, by a word of load_one: an
/// illuminant by its name, all else as samples, interpolated as it was read. Files are looked for
/// in `folder` first. Errors: those of load_one; power below 0, a reflectance out of 0..1 or in
/// place of a light.
Result<v1::Spectrum> embedded_spectrum(const std::string& word, SpectrumRole role,
                                       const std::filesystem::path& folder = {});

/// What a word is, a light or a paint, where nobody says what it is for. Errors as above.
Result<SpectrumRole> role_of_word(const std::string& word,
                                  const std::filesystem::path& folder = {});

}  // namespace metamer::client
