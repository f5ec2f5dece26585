#pragma once

#include <gtest/gtest.h>
#include <png.h>

#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

namespace metamer {

/// A PNG as a test writes it, by libpng; chunks that are for its numbers' meaning, byte by byte.
struct TestPng {
  int width = 1;
  int height = 1;
  int color_type = PNG_COLOR_TYPE_RGB;
  int bits = 8;
  std::vector<unsigned char> bytes;  ///< Rows, packed as the format has them.
  std::vector<std::pair<std::string, std::string>> chunks = {};  ///< Before PLTE.
  std::vector<png_color> palette = {};
  std::string transparency = {};  ///< tRNS, behind PLTE.
  bool interlaced = false;
};

/// Numbers of two or four bytes, the high one first.
inline std::string big_endian(std::uint32_t number, int bytes = 4) {
  std::string text;
  for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8)
    text += static_cast<char>(number >> shift & 0xFF);
  return text;
}

inline void write_test_png(const std::filesystem::path& file, TestPng test) {
  std::FILE* const to = std::fopen(file.c_str(), "wb");
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
  png_infop info = png_create_info_struct(png);
  if (setjmp(png_jmpbuf(png))) FAIL() << "libpng";
  png_init_io(png, to);
  png_set_IHDR(png, info, static_cast<png_uint_32>(test.width),
               static_cast<png_uint_32>(test.height), test.bits, test.color_type,
               test.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
               PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  if (!test.palette.empty())
    png_set_PLTE(png, info, test.palette.data(), static_cast<int>(test.palette.size()));
  png_write_info_before_PLTE(png, info);
  const auto write_chunk = [&](const std::string& name, const std::string& data) {
    png_write_chunk(png, reinterpret_cast<png_const_bytep>(name.data()),
                    reinterpret_cast<png_const_bytep>(data.data()), data.size());
  };
  for (const auto& [name, data] : test.chunks) write_chunk(name, data);
  png_write_info(png, info);
  if (!test.transparency.empty()) write_chunk("tRNS", test.transparency);
  const std::size_t row = test.bytes.size() / static_cast<std::size_t>(test.height);
  std::vector<png_bytep> rows;
  for (std::size_t at = 0; at < test.bytes.size(); at += row) rows.push_back(&test.bytes[at]);
  png_write_image(png, rows.data());
  png_write_end(png, nullptr);
  png_destroy_write_struct(&png, &info);
  std::fclose(to);
}

}  // namespace metamer
