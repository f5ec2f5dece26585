#include "client/cli/commands.h"

namespace metamer::cli {

Command commands::spectra() {
  return {.name = "spectra", .meaning = "explain, plot, resample, convert and match spectra"};
}

}  // namespace metamer::cli
