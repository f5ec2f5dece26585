#pragma once

#include <string>
#include <vector>

#include "client/tools/spectra/spectra_files.h"

/// Spectra with the words by which each of them is found again.
namespace metamer::client {

struct WordedSpectrum {
  std::string word;  ///< As parse_spectrum_word takes it; empty: no word says it.
  LoadedSpectrum spectrum;
};

/// The spectra of a word (load_spectra), each with a word that means it alone, and labelled by its
/// file without the folders.
SpectrumResult<std::vector<WordedSpectrum>> worded_spectra(const std::string& word,
                                                           const SpectrumChoice& choice = {});

}  // namespace metamer::client
