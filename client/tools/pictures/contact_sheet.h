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
  Image map = {};    ///< Where they are, as map_for_sheet makes it; of the reference nothing.
  std::string title = {}, note = {};  ///< Of a cell of picture_grid: above and below it.
};

struct Sheet {
  std::vector<std::string> lights;      ///< Headings of the columns, at least one.
  std::vector<std::string> candidates;  ///< Of the rows, the first of which is the reference.
  std::vector<SheetCell> cells;         ///< Row by row; as large as the largest of their pictures.
  bool maps = false;                    ///< Below each picture but the reference stands its map.
};

/// Pictures that have their own titles, as many side by side as make the sheet about as wide as it
/// is high; a cell without a picture has its words alone. Errors: those of contact_sheet; there is
/// no picture at all.
Result<Image> picture_grid(std::vector<SheetCell> cells);

/// Puts a cell's difference down: of the pixels that differ, by 0.005 at least.
void set_difference(const Difference& difference, SheetCell& cell);

/// The ΔE00 of each pixel, in the size of for_sheet.
Image map_for_sheet(const Difference& difference);

/// A picture (X Y Z, as a screen of D65 is to show it) in the size that it has on a sheet: smaller
/// by a whole number, by means of X Y Z, until it is at most sheet_width wide, or larger by one,
/// each pixel a square, where it can be.
Image for_sheet(const Image& picture);

/// One picture of all, in X Y Z, on dark grey: above each its light and its candidate, below it the
/// mean and the maximum of its ΔE00 where it differs. Maps are in false colours (common/image/ramp)
/// on one scale, up to the largest 99th percentile of any of them, with a legend at the end.
/// Errors: those of draw_labels; a sheet of more than max_image_values.
Result<Image> contact_sheet(const Sheet& sheet);

inline constexpr int sheet_width = 360;  ///< Pixels.

}  // namespace metamer::client
