#pragma once

#include <string>
#include <vector>

#include "common/image/image.h"
#include "process.h"

namespace metamer::test {

/// A picture with shadows, a mirror and highlights, small enough for a blink.
std::string small_scene();
/// The same, large enough for seconds of rendering on one thread: time to do something to it.
std::string long_scene();
/// The same, so large that nobody waits for its end.
std::string endless_scene();

/// The pixels of an .exr; an empty picture and a failure where there is none.
Image read_exr(const std::string& file);
/// Bit for bit, all of it.
void expect_same_pixels(const Image& a, const Image& b, const std::string& what);
/// Not a picture of nothing: some pixel is above 0.
void expect_a_picture(const Image& image);

}  // namespace metamer::test
