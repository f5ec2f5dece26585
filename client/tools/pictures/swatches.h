#pragma once

#include <vector>

#include "client/tools/spectra/paint_match.h"
#include "common/image/image.h"

namespace metamer::client {

inline constexpr int swatch_size = 96, swatch_gap = 8;      ///< Pixels; a gap surrounds each.
inline constexpr int swatch_text = 21, swatch_names = 180;  ///< A line's height; a name's width.

/// A picture of paints in X Y Z, adapted (Bradford) to D65: a row for each candidate, a column for
/// each light, each a square of which the left half is the reference and the right the candidate,
/// on neutral grey of Y 0.2. Above stand the lights, at the left the candidates, below each square
/// its ΔE00. `matches` has at least one. Error: that of draw_labels.
Result<Image> swatches(const std::vector<PaintMatch>& matches);

}  // namespace metamer::client
