#pragma once

#include <vector>

#include "client/tools/figures/figure.h"

namespace metamer::client {

/// Those of the source's Figs. 2-2 to 2-11 that are diagrams (2-7 is a drawing), with the
/// parameters of their captions. Where a caption leaves one open, source_figures.cpp says what was
/// chosen.
std::vector<Figure> source_figures();

}  // namespace metamer::client
