#include "client/tools/pictures/comparison.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/color/srgb.h"

namespace metamer::client {

White srgb_white() { return {"D65 (sRGB)", srgb::to_xyz({1, 1, 1})}; }

Result<White> white_under(const std::string& name, const Spectrum& light,
                          const Observer& observer) {
  const Xyz white = white_of(light, observer);
  if (!std::all_of(white.begin(), white.end(), [](double value) { return value > 0; }))
    return problem(quoted(name) + " is no white to this observer");
  return White{name, white};
}

tl::expected<PicturePair, std::vector<Problem>> read_pair(
    const std::array<std::string, 2>& files, const Viewing& viewing,
    const std::array<PictureChoice, 2>& choices) {
  PicturePair pictures;
  std::vector<Problem> problems;
  for (std::size_t i = 0; i < files.size(); ++i) {
    Result<XyzPicture> read = read_xyz(files[i], viewing, choices[i]);
    if (read)
      pictures[i] = std::move(*read);
    else
      problems.push_back(std::move(read.error()));
  }
  if (!problems.empty()) return tl::unexpected(std::move(problems));
  return pictures;
}

Result<void> same_units(const PicturePair& pictures) {
  const std::string &a = pictures[0].units, &b = pictures[1].units;
  if (a == b || a.empty() || b.empty()) return {};
  return problem("the pictures have different units: " + quoted(a) + " and " + quoted(b));
}

std::optional<NotFinite> first_not_finite(const Difference& difference, const Image& first) {
  const ErrorStatistics& all = difference.statistics;
  if (all.not_finite == 0) return std::nullopt;
  const float* pixel = first.pixels.data() + 3 * all.first_not_finite;
  const bool in_first =
      !std::all_of(pixel, pixel + 3, [](float value) { return std::isfinite(value); });
  return NotFinite{pixel_at(all.first_not_finite, difference.width), in_first ? 0u : 1u};
}

bool is_over(const ErrorStatistics& statistics, double limit) {
  return statistics.maximum > limit || statistics.not_finite > 0;
}

}  // namespace metamer::client
