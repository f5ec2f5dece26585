#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/color/error_statistics.h"
#include "common/image/compare.h"
#include "common/image/image.h"

/// Pictures side by side: lights across, candidates down.
namespace metamer::client {

/// A picture under one light with one candidate.
struct SheetCell {
  Image picture;  ///< As for_sheet makes it.
  /// ΔE00 from the reference under this light, of the pixels that differ; nothing: it has none.
  std::optional<ErrorStatistics> difference = {};
  double share = 0;  ///< How many these are of all.
};

struct Sheet {
  std::vector<std::string> lights;      ///< Headings of the columns, at least one.
  std::vector<std::string> candidates;  ///< Of the rows, the first of which is the reference.
  std::vector<SheetCell> cells;         ///< Row by row; pictures of one size.
};

/// Puts a cell's difference down: of the pixels that differ at all.
void set_difference(const Difference& difference, SheetCell& cell);

/// A picture (X Y Z, as a screen of D65 is to show it) in the size that it has on a sheet: smaller
/// by a whole number, by means of X Y Z, until it is at most sheet_width wide, or larger by one,
/// each pixel a square, where it can be.
Image for_sheet(const Image& picture);

/// One picture of all, in X Y Z, on dark grey: above each its light and its candidate, below it the
/// mean and the maximum of its ΔE00 where it differs. Errors: those of draw_labels; a sheet of
/// more than max_image_values.
Result<Image> contact_sheet(const Sheet& sheet);

inline constexpr int sheet_width = 360;  ///< Pixels.

}  // namespace metamer::client
