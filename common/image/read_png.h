#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>

#include "common/image/image.h"
#include "common/image/picture_file.h"

namespace metamer {

/// A PNG of any kind: grey or colour, by a palette, with or without alpha, 1 to 16 bits,
/// interlaced.
struct PngPicture {
  Image image;   ///< R G B or Y, then A where something may be transparent; 0..1 as stored.
  int bits = 8;  ///< Of a sample; 16 or, for all fewer, 8.
  // What it says of its numbers: the chunks of PNG (3rd edition), 11.3.2.
  std::optional<std::array<unsigned char, 4>> cicp;  ///< Primaries, transfer, matrix, full range.
  std::string icc_profile;
  bool srgb = false;
  std::optional<double> gamma;                          ///< Encoded is linear to this power.
  std::optional<std::array<double, 8>> chromaticities;  ///< x y of white, red, green, blue.
  std::map<std::string, std::string> faults;  ///< By chunk: why what it says can't be used.
};

/// What the samples of a PNG with a palette, or of fewer than 8 bits, are.
enum class PngSamples {
  colors,   ///< Those of the palette; the fewer bits spread over 0..1.
  numbers,  ///< As stored, with the palette left aside: n becomes n / 255.
};

/// Reads a .png that is there, by libpng. Errors name the file: one that is damaged, or of more
/// than max_image_values values.
Result<PngPicture> read_png(const PictureSource& source, PngSamples samples = PngSamples::colors);

}  // namespace metamer
