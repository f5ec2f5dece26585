#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "common/problem.h"
#include "common/scene/validate.h"

namespace metamer {

/// What shines from all directions, as a latitude-longitude picture: row 0 is around +y, the middle
/// of a row where −z is, its first quarter where −x is. Each pixel shines alike over its part of
/// the sphere, of longitudes of one width and latitudes of one height.
struct SkyPicture {
  std::uint32_t width = 0, height = 0;
  std::vector<double> nm;     ///< Of a spectral picture's bands, rising; else empty: linear sRGB.
  std::vector<float> values;  ///< Not negative; row by row, those of a pixel together.

  std::size_t parts() const { return nm.empty() ? 3 : nm.size(); }  ///< Values of a pixel.
  std::span<const float> at(std::uint32_t x, std::uint32_t y) const {
    return std::span(values).subspan((std::size_t{y} * width + x) * parts(), parts());
  }
};

/// Larger pictures of R G B are averaged down to this, 100 MB, and finer than most see in a
/// reflection; spectral ones to as many values.
inline constexpr std::uint32_t max_sky_width = 4096, max_sky_height = 2048;
inline constexpr std::size_t max_sky_bands = 32;  ///< Each is a light.

struct ReadSky {
  SkyPicture picture;
  std::vector<std::string> notes;  ///< What was guessed or averaged, a sentence each.
};

/// Of an .exr's bytes, by strips of its rows, so that memory is bounded by what is kept. Errors
/// name the file: what read_exr() refuses, no R G B, Y or radiance by bands (max_sky_bands; means
/// as spectral_exr.h has them), a pixel that is negative or not finite, a picture that is black.
Result<ReadSky> read_sky_picture(const std::string& bytes, const std::string& name);

/// The picture of an environment's file.
using SkyImport = std::function<Result<std::shared_ptr<const ReadSky>>(const std::string& file)>;
SkyImport skies_of(const AssetReader& assets);

}  // namespace metamer
