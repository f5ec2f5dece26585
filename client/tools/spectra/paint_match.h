#pragma once

#include <optional>
#include <string>
#include <utility>
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

/// The places of two paints that could be taken for each other under the first light (ΔE00 below 1)
/// and part the most under another; nothing: no two can. Of many paints the first `most_paired`
/// are looked at. A dark light parts none.
std::optional<std::pair<std::size_t, std::size_t>> metameric_pair(
    const std::vector<NamedSpectrum>& paints, const std::vector<NamedSpectrum>& lights,
    const Observer& observer);
inline constexpr std::size_t most_paired = 64;

}  // namespace metamer::client
