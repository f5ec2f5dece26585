#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace metamer::test {

/// An .exr without compression, written by hand after openexr.com, "OpenEXR File Layout". The
/// channels are in the alphabet's order, as a pixel's values are.
inline std::string sky_file(int width, int height, const std::vector<std::string>& channels,
                            const std::vector<std::vector<float>>& pixels) {
  std::string file("\x76\x2f\x31\x01\x02\0\0\0", 8);
  const auto raw = [&](const auto& value) {
    file.append(reinterpret_cast<const char*>(&value), sizeof value);
  };
  const auto attribute = [&](const char* name, const char* type, std::size_t size) {
    file.append(name).push_back('\0');
    file.append(type).push_back('\0');
    raw(static_cast<int>(size));
  };
  std::size_t list = 1;
  for (const std::string& name : channels) list += name.size() + 17;
  attribute("channels", "chlist", list);
  for (const std::string& name : channels) {
    file.append(name).push_back('\0');
    for (const int value : {2, 0, 1, 1}) raw(value);  // float, one sample a pixel
  }
  file.push_back('\0');
  attribute("compression", "compression", 1);
  file.push_back('\0');
  for (const char* window : {"dataWindow", "displayWindow"}) {
    attribute(window, "box2i", 16);
    for (const int value : {0, 0, width - 1, height - 1}) raw(value);
  }
  attribute("lineOrder", "lineOrder", 1);
  file.push_back('\0');
  attribute("pixelAspectRatio", "float", 4);
  raw(1.0F);
  attribute("screenWindowCenter", "v2f", 8);
  raw(0.0F);
  raw(0.0F);
  attribute("screenWindowWidth", "float", 4);
  raw(1.0F);
  file.push_back('\0');
  const int bytes = 4 * static_cast<int>(channels.size()) * width;
  const std::uint64_t first = file.size() + 8 * static_cast<std::uint64_t>(height);
  for (int y = 0; y < height; ++y)
    raw(first + static_cast<std::uint64_t>(y) * (8 + static_cast<std::uint64_t>(bytes)));
  for (int y = 0; y < height; ++y) {
    raw(y);
    raw(bytes);
    for (std::size_t channel = 0; channel < channels.size(); ++channel)
      for (int x = 0; x < width; ++x) raw(pixels[static_cast<std::size_t>(y * width + x)][channel]);
  }
  return file;
}

inline std::string sky_file(int width, int height, const std::vector<std::array<float, 3>>& rgb) {
  std::vector<std::vector<float>> bgr;
  for (const auto& pixel : rgb) bgr.push_back({pixel[2], pixel[1], pixel[0]});
  return sky_file(width, height, {"B", "G", "R"}, bgr);
}

}  // namespace metamer::test
