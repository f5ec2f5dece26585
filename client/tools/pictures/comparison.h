#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "common/color/xyz.h"
#include "common/image/compare.h"
#include "common/image/read_xyz.h"

/// Two picture files, to be compared by common/image/compare.h.
namespace metamer::client {

/// What looks white, and how it is called.
struct White {
  std::string name;
  Xyz xyz;  ///< At Y = 1 unless somebody chose otherwise.
};

/// R = G = B = 1 of sRGB.
White srgb_white();

/// Of a light. Error: the observer sees no X, Y or Z of it, so that nothing compares with it.
Result<White> white_under(const std::string& name, const Spectrum& light, const Observer& observer);

using PicturePair = std::array<XyzPicture, 2>;

/// Both pictures as X Y Z, each as its choice means it. The errors are what is wrong with each file
/// that can't be read, in their order.
tl::expected<PicturePair, std::vector<Problem>> read_pair(
    const std::array<std::string, 2>& files, const Viewing& viewing,
    const std::array<PictureChoice, 2>& choices = {});

/// Emissions compare in one unit; a file that names none is taken at its word. Error: two units.
Result<void> same_units(const PicturePair& pictures);

/// A pixel, counted from the upper left.
struct Pixel {
  std::size_t x, y;
  bool operator==(const Pixel&) const = default;
};
inline Pixel pixel_at(std::size_t at, int width) {
  return {at % static_cast<std::size_t>(width), at / static_cast<std::size_t>(width)};
}

/// The first pixel that has no finite colour in one of the pictures.
struct NotFinite {
  Pixel pixel;
  std::size_t picture;  ///< 0 or 1: the first of the two in which it has none.
};
std::optional<NotFinite> first_not_finite(const Difference& difference, const Image& first);

/// Whether a difference is above the limit somewhere; a pixel without a finite colour keeps to
/// none.
bool is_over(const ErrorStatistics& statistics, double limit);

}  // namespace metamer::client
