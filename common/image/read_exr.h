#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/image/image.h"
#include "common/image/picture_file.h"

/// EXR files of any kind but deep ones are read, by OpenEXR; in the calling thread alone.
namespace metamer {

/// A rectangle of pixels; (x1, y1) belongs to it.
struct PixelWindow {
  int x0 = 0;
  int y0 = 0;
  int x1 = -1;
  int y1 = -1;

  int width() const { return x1 - x0 + 1; }
  int height() const { return y1 - y0 + 1; }
  bool operator==(const PixelWindow&) const = default;
};

struct ExrChannel {
  std::string name;
  bool whole_numbers = false;  ///< uint; else half or float.
  bool subsampled = false;     ///< It has fewer samples than there are pixels.
};

/// What an EXR says of one of its parts; a file of a single part may leave its name empty.
struct ExrPart {
  std::string name;
  std::string view;  ///< "left"; empty: not said.
  std::string type;  ///< "scanlineimage", "tiledimage", "deepscanline", "deeptile"; may be empty.
  PixelWindow display;  ///< The picture.
  PixelWindow data;     ///< Where there are values.
  std::vector<ExrChannel> channels;
  std::vector<float> chromaticities;  ///< x y of red, green, blue, white; empty: not said.
  std::string emissive_units;         ///< The attribute emissiveUnits; empty: not said.

  bool deep() const { return type.starts_with("deep"); }
};

/// The parts of an .exr that is there, in the file's order; at least one.
Result<std::vector<ExrPart>> read_exr_parts(const PictureSource& source);

/// Channels of part number `part`, in the order of `channels`, over its display window, or over
/// `only` of it, counted from its upper left; 0 outside of its data window. Half and uint become
/// f32. Errors name the file: a deep part, a channel with fewer samples than there are pixels,
/// windows with no pixel in common or more than max_image_values values, a file that is damaged or
/// has changed since `parts` were read.
Result<Image> read_exr(const PictureSource& source, const std::vector<ExrPart>& parts,
                       std::size_t part, const std::vector<std::string>& channels,
                       const std::optional<PixelWindow>& only = {});

}  // namespace metamer
