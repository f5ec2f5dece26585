#pragma once

#include <string>
#include <vector>

#include "common/color/rgb_space.h"
#include "common/image/read_png.h"

namespace metamer {

/// What a PNG without an ICC profile says of its numbers.
struct PngEncoding {
  Primaries primaries;
  Transfer transfer;
  double black = 0;                ///< The number that is 0; of video 16/255.
  double white = 1;                ///< The number that is 1.
  std::string what;                ///< "sRGB", "Display P3's primaries, sRGB's curve (cICP 12, 13)"
  std::vector<std::string> notes;  ///< What was guessed.
};

/// Whether its ICC profile counts: it has one, or one that is damaged, and no cICP comes before.
bool goes_by_icc(const PngPicture& png);

/// By the first of cICP, sRGB, gAMA with cHRM that is there (PNG, 3rd edition, 4.3); sRGB where
/// none is. cICP by ITU-T H.273 (2021), tables 2 and 3; the curves of cameras (1, 6, 14, 15) as the
/// screen of ITU-R BT.1886 shows them, with black at 0. Errors: a chunk that is damaged, and what a
/// comparison of screens can't tell: PQ, HLG, matrices and codes that name no screen.
Result<PngEncoding> png_encoding(const PngPicture& png);

}  // namespace metamer
