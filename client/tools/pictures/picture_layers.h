#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/image/exr_layers.h"

namespace metamer::client {

/// One of several pictures in a file.
struct PictureLayer {
  std::string name;  ///< For people: `part "C", layer "diffuse"`.
  PictureChoice choice;
};

/// The pictures that an .exr has, in its order; none where there is only one, and of what is no
/// .exr or can't be read.
std::vector<PictureLayer> picture_layers(const std::filesystem::path& file);

}  // namespace metamer::client
