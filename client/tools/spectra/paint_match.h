#pragma once

#include <string>
#include <vector>

#include "common/color/metamerism.h"

/// Which of several paints is nearest to one, under several lights.
namespace metamer::client {

/// A candidate beside the reference.
struct PaintMatch {
  std::string name;
  std::vector<Mismatch> under;         ///< As many as the lights.
  std::vector<MetamerismIndex> index;  ///< From the first light to each.
  std::size_t worst = 0;               ///< The light of the largest ΔE00.

  double worst_de00() const { return under[worst].de00; }
};

/// Each of `candidates` beside `reference` under each of `lights` (at least one), in their order.
/// Error: that of metamerism().
Result<std::vector<PaintMatch>> match_paints(const Spectrum& reference,
                                             const std::vector<NamedSpectrum>& candidates,
                                             const std::vector<NamedSpectrum>& lights,
                                             const Observer& observer);

/// The candidate whose largest ΔE00 is the smallest; of equals the first. `matches` has at least
/// one.
const PaintMatch& nearest(const std::vector<PaintMatch>& matches);

}  // namespace metamer::client
