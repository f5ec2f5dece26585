#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/problem.h"
#include "common/spectral/files/interpret.h"
#include "common/spectral/interpolation.h"

namespace metamer::client {

/// A spectrum as it is written on a command line: a name, or FILE, FILE#ENTRY, FILE@WORD… and
/// FILE#ENTRY@WORD…, whose words say how the file is read: "lamps.csv#warm@um@clamp".
struct SpectrumWord {
  std::string name;                       ///< A file's, where `is_file`.
  bool is_file = false;                   ///< There is such a file.
  std::optional<std::string> entry = {};  ///< Which of a file's spectra.
  Reading reading = {};                   ///< What its words say.
  std::optional<Interpolation> interpolation = {};
};

/// Takes a word apart. A file that is called like the whole word is that file. Errors: a word after
/// the @ of a file that is none of reading_words; such words after what is no file.
Result<SpectrumWord> parse_spectrum_word(const std::string& text);

/// What may stand after @: quantities, units, scales, clamp, interpolations.
const std::vector<std::string>& reading_words();

}  // namespace metamer::client
