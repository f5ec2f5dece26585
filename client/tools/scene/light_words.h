#pragma once

#include <filesystem>
#include <string>

#include "common/problem.h"
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

}  // namespace metamer::client
