#include "scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

namespace metamer::test {
namespace {

const char* const world = R"(
camera { eye { y: 1.2 z: 4 } target { y: 0.6 } vertical_fov: 40 }
light { name: "lamp" position { x: 1 y: 3 z: 2 } spectrum { standard: "A" } luminance: 0.8 }
light { name: "sun" direction { x: 1 y: -2 z: -1 } spectrum { standard: "D65" } luminance: 0.4 }
material { name: "floor" diffuse { samples { wavelength: 400 wavelength: 700 value: 0.2 value: 0.7 } }
           specular { constant: 1 } mirror: 0.2 }
material { name: "ball" diffuse { samples { wavelength: 400 wavelength: 700 value: 0.8 value: 0.1 } }
           specular { constant: 1 } diffuseness: 0.7 specularness: 0.3 blinn_phong { shininess: 60 } }
object { name: "floor" material: "floor" quad { corner { x: -3 z: 2 } u { x: 6 } v { z: -5 } } }
object { name: "ball" material: "ball" sphere { center { y: 0.6 } radius: 0.6 } }
)";

}  // namespace

std::string small_scene() {
  std::string text = world;
  text += "settings { width: 75 height: 53 spp: 4 }\n";
  return text;
}

std::string long_scene() {
  // Thousands of tiles: a picture in the making can be stopped anywhere.
  std::string text = world;
  text +=
      "settings { width: 640 height: 480 spp: 32 tile_size: 8\n"
      "  method { point { from: 380 to: 780 step: 1 } } }\n";
  return text;
}

std::string endless_scene() {
  std::string text = world;
  text += "settings { width: 2048 height: 2048 spp: 1024 tile_size: 8 }\n";
  return text;
}

Image read_exr(const std::string& file) {
  Result<Image> image = read_image(file);
  EXPECT_TRUE(image) << (image ? "" : format(image.error()));
  return image ? std::move(*image) : Image{};
}

void expect_same_pixels(const Image& a, const Image& b, const std::string& what) {
  ASSERT_EQ(a.width, b.width) << what;
  ASSERT_EQ(a.height, b.height) << what;
  ASSERT_EQ(a.channels, b.channels) << what;
  ASSERT_FALSE(a.pixels.empty()) << what;
  EXPECT_EQ(std::memcmp(a.pixels.data(), b.pixels.data(), a.pixels.size() * sizeof(float)), 0)
      << what;
}

void expect_a_picture(const Image& image) {
  EXPECT_TRUE(std::any_of(image.pixels.begin(), image.pixels.end(), [](float v) { return v > 0; }));
}

}  // namespace metamer::test
