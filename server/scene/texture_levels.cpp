#include <algorithm>
#include <cmath>

#include "server/scene/texture.h"

namespace metamer {
namespace {

using Weights = std::vector<std::uint16_t>;

/// The part of the level before that a pixel stands for, along one side: from its first pixel on.
struct Part {
  std::size_t first;
  std::vector<float> shares;  ///< They sum to 1.
};

std::vector<Part> parts_of(std::uint32_t from, std::uint32_t to) {
  std::vector<Part> parts;
  const double step = static_cast<double>(from) / to;
  for (std::uint32_t i = 0; i < to; ++i) {
    const double begin = i * step, end = begin + step;
    Part part{static_cast<std::size_t>(begin), {}};
    for (std::size_t j = part.first; j < from && static_cast<double>(j) < end; ++j) {
      const double covered =
          std::min(end, static_cast<double>(j + 1)) - std::max(begin, static_cast<double>(j));
      part.shares.push_back(static_cast<float>(covered / step));
    }
    parts.push_back(std::move(part));
  }
  return parts;
}

/// Appends to `weights` the level of half the size behind `from`.
TexturePicture::Level add_half(const TexturePicture::Level& from, std::uint32_t channels,
                               Weights& weights) {
  const TexturePicture::Level to{std::max(1u, from.width / 2), std::max(1u, from.height / 2),
                                 weights.size()};
  const std::vector<Part> columns = parts_of(from.width, to.width),
                          rows = parts_of(from.height, to.height);
  std::vector<float> sums(channels);
  for (const Part& row : rows) {
    for (const Part& column : columns) {
      std::fill(sums.begin(), sums.end(), 0.0f);
      for (std::size_t y = 0; y < row.shares.size(); ++y) {
        const std::size_t line = from.first + (row.first + y) * from.width * channels;
        for (std::size_t x = 0; x < column.shares.size(); ++x) {
          const float share = row.shares[y] * column.shares[x];
          const std::size_t pixel = line + (column.first + x) * channels;
          for (std::uint32_t c = 0; c < channels; ++c)
            sums[c] += share * static_cast<float>(weights[pixel + c]);
        }
      }
      for (const float sum : sums)
        weights.push_back(static_cast<std::uint16_t>(std::lround(std::min(sum, 65535.0f))));
    }
  }
  return to;
}

}  // namespace

TexturePicture with_levels(std::uint32_t width, std::uint32_t height, std::uint32_t channels,
                           std::vector<std::uint16_t> weights) {
  TexturePicture picture;
  picture.channels = channels;
  picture.levels.push_back({width, height, 0});
  weights.reserve(weights.size() + weights.size() / 2 + 64 * channels);
  while (picture.levels.back().width > 1 || picture.levels.back().height > 1)
    picture.levels.push_back(add_half(picture.levels.back(), channels, weights));
  picture.weights = Array<std::uint16_t>(std::move(weights));
  return picture;
}

}  // namespace metamer
