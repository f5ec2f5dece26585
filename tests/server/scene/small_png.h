#pragma once

#include <zlib.h>

#include <cstdint>
#include <string>

namespace metamer::test {

/// The bytes of a PNG of 8 bits (3rd edition, 5): `color_type` 0 grey, 2 R G B, 3 a palette, which
/// has 256 reds then, 6 R G B A. `samples`: row by row from the top.
inline std::string small_png(std::uint32_t width, std::uint32_t height, int color_type,
                             const std::string& samples) {
  const auto number = [](std::uint32_t n) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(n >> shift);
    return bytes;
  };
  const auto chunk = [&](const std::string& name, const std::string& data) {
    const std::string all = name + data;
    const auto crc =
        crc32(0, reinterpret_cast<const Bytef*>(all.data()), static_cast<uInt>(all.size()));
    return number(static_cast<std::uint32_t>(data.size())) + all +
           number(static_cast<std::uint32_t>(crc));
  };
  std::string rows;
  const std::size_t row = samples.size() / height;
  for (std::uint32_t y = 0; y < height; ++y) rows += '\0' + samples.substr(y * row, row);
  std::string packed(compressBound(rows.size()), '\0');
  uLongf size = packed.size();
  compress(reinterpret_cast<Bytef*>(packed.data()), &size,
           reinterpret_cast<const Bytef*>(rows.data()), rows.size());
  packed.resize(size);
  std::string palette;
  for (int i = 0; color_type == 3 && i < 256; ++i) palette += std::string{'\xFF', '\0', '\0'};
  return "\x89PNG\r\n\x1A\n" +
         chunk("IHDR", number(width) + number(height) +
                           std::string{'\x08', static_cast<char>(color_type), '\0', '\0', '\0'}) +
         (palette.empty() ? "" : chunk("PLTE", palette)) + chunk("IDAT", packed) +
         chunk("IEND", "");
}

}  // namespace metamer::test
