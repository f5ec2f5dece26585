#pragma once

#include <string>

#include "client/tools/figures/figure.h"

namespace metamer::cli {

/// The program that makes gnuplot write the figure as a PNG on its stdout. It names no file.
std::string gnuplot_script(const client::Figure& figure);

}  // namespace metamer::cli
