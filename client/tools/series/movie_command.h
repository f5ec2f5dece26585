#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "client/tools/series/frame_name.h"

namespace metamer::client {

/// What makes a movie, turntable.mp4, of .png files that are all there, in a shell with ffmpeg. The
/// frames are two or more, as parse_frames gives them. `even`: so are width and height, which H.264
/// demands.
std::string movie_command(const FrameName& name, const std::vector<std::uint32_t>& frames,
                          bool even);

}  // namespace metamer::client
