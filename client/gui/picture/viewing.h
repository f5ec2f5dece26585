#pragma once

#include <QColorSpace>
#include <QRgb>

#include "common/image/image.h"

namespace metamer::gui {

/// How pictures are looked at, whatever they are of.
struct Viewing {
  double stops = 0;    ///< EV: light times 2^stops, before the code table.
  bool gamut = false;  ///< What the output can't show is marked.
  QColorSpace display{QColorSpace::SRgb};

  bool operator==(const Viewing&) const = default;
};

inline constexpr QRgb gamut_mark = 0xffff00ff;

/// That of the numbers which `developing` makes.
QColorSpace color_space(const Developing& developing);

}  // namespace metamer::gui
