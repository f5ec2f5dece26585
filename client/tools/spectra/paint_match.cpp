#include "client/tools/spectra/paint_match.h"

#include <algorithm>

namespace metamer::client {

Result<std::vector<PaintMatch>> match_paints(const Spectrum& reference,
                                             const std::vector<NamedSpectrum>& candidates,
                                             const std::vector<NamedSpectrum>& lights,
                                             const Observer& observer) {
  std::vector<PaintMatch> matches;
  for (const NamedSpectrum& candidate : candidates) {
    auto under = metamerism(reference, candidate.spectrum, lights, observer);
    if (!under) return tl::unexpected(std::move(under.error()));
    PaintMatch match{.name = candidate.name, .under = std::move(*under), .index = {}};
    for (std::size_t i = 0; i < match.under.size(); ++i) {
      match.index.push_back(metamerism_index(match.under.front(), match.under[i]));
      if (match.under[i].de00 > match.worst_de00()) match.worst = i;
    }
    matches.push_back(std::move(match));
  }
  return matches;
}

std::optional<std::pair<std::size_t, std::size_t>> metameric_pair(
    const std::vector<NamedSpectrum>& paints, const std::vector<NamedSpectrum>& lights,
    const Observer& observer) {
  constexpr double alike = 1;
  std::optional<std::pair<std::size_t, std::size_t>> pair;
  double farthest = 0;
  const std::size_t count = std::min(paints.size(), most_paired);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t j = i + 1; j < count; ++j) {
      // The first light alone tells most of them apart.
      const auto first =
          metamerism(paints[i].spectrum, paints[j].spectrum, {lights.front()}, observer);
      if (!first || first->front().de00 >= alike) continue;
      const auto under = metamerism(paints[i].spectrum, paints[j].spectrum, lights, observer);
      if (!under) continue;
      for (const Mismatch& one : *under)
        if (one.de00 > farthest) {
          farthest = one.de00;
          pair = {i, j};
        }
    }
  return pair;
}

const PaintMatch& nearest(const std::vector<PaintMatch>& matches) {
  return *std::min_element(
      matches.begin(), matches.end(),
      [](const PaintMatch& a, const PaintMatch& b) { return a.worst_de00() < b.worst_de00(); });
}

}  // namespace metamer::client
