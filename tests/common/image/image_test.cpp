#include "common/image/image.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <ctime>
#include <fstream>
#include <limits>
#include <random>

#include "common/color/srgb.h"
#include "image_file.h"

namespace metamer {
namespace {

namespace fs = std::filesystem;

/// An XYZ image, one pixel high, of linear RGB values.
Image row_of(const std::vector<srgb::Rgb>& linear) {
  Image image = make_image(static_cast<int>(linear.size()), 1, {"X", "Y", "Z"});
  for (std::size_t i = 0; i < linear.size(); ++i) {
    const Xyz xyz = srgb::to_xyz(linear[i]);
    for (std::size_t c = 0; c < 3; ++c) image.pixels[3 * i + c] = static_cast<float>(xyz[c]);
  }
  return image;
}

Image noise(int width, int height) {
  Image image = make_image(width, height, {"X", "Y", "Z"});
  std::mt19937 random(1);
  std::normal_distribution<float> normal(0.5F, 1.0F);
  for (float& value : image.pixels) value = normal(random);
  return image;
}

std::string error_of(const Result<GamutReport>& result) {
  return result ? "no error" : format(result.error());
}

std::string slurp(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

bool same_bits(const std::vector<float>& a, const std::vector<float>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

/// Channel `name` of `image`.
std::vector<float> channel(const Image& image, const std::string& name) {
  std::vector<float> values;
  for (std::size_t c = 0; c < image.channels.size(); ++c) {
    if (image.channels[c] != name) continue;
    for (std::size_t i = c; i < image.pixels.size(); i += image.channels.size()) {
      values.push_back(image.pixels[i]);
    }
  }
  return values;
}

TEST_F(ImageFile, ExrOfXyzComesBackBitForBit) {
  // More rows than are converted at a time, and numbers that are hard to keep.
  Image image = noise(37, 150);
  image.pixels[0] = std::numeric_limits<float>::infinity();
  image.pixels[1] = -std::numeric_limits<float>::infinity();
  image.pixels[2] = std::numeric_limits<float>::quiet_NaN();
  image.pixels[3] = std::numeric_limits<float>::denorm_min();
  image.pixels[4] = -0.0F;
  image.pixels[5] = std::numeric_limits<float>::max();
  const auto report = write_image(image, folder_ / "a.exr", true, {});
  ASSERT_TRUE(report) << format(report.error());
  EXPECT_EQ(report->negative + report->above, 0U) << "nothing was clipped";

  const auto back = read_image(folder_ / "a.exr");
  ASSERT_TRUE(back) << format(back.error());
  EXPECT_EQ(back->width, 37);
  EXPECT_EQ(back->height, 150);
  for (const char* name : {"X", "Y", "Z"}) {
    EXPECT_TRUE(same_bits(channel(*back, name), channel(image, name))) << name;
  }
}

TEST_F(ImageFile, ExrOfRgbHoldsUnclippedLinearSrgb) {
  const Image image = noise(70, 70);
  ASSERT_TRUE(write_image(image, folder_ / "a.EXR", false, {}));
  const auto back = read_image(folder_ / "a.EXR");
  ASSERT_TRUE(back) << format(back.error());
  EXPECT_EQ(back->channels, (std::vector<std::string>{"R", "G", "B"}));
  ASSERT_EQ(back->pixels.size(), image.pixels.size());
  for (std::size_t i = 0; i < image.pixels.size(); i += 3) {
    const float* xyz = &image.pixels[i];
    const srgb::Rgb rgb = srgb::from_xyz({xyz[0], xyz[1], xyz[2]});
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_EQ(back->pixels[i + c], static_cast<float>(rgb[c]));
    }
  }
}

TEST_F(ImageFile, ExrSaysItsPrimariesAndMetadata) {
  const std::map<std::string, std::string> metadata = {{"metamer:plan", "point, 61 samples"},
                                                       {"metamer:scene", "Größe\nzwei Zeilen"}};
  ASSERT_TRUE(write_image(noise(2, 2), folder_ / "a.exr", false, metadata));
  const auto input = OIIO::ImageInput::open((folder_ / "a.exr").string());
  ASSERT_TRUE(input);
  float chromaticities[8] = {};
  ASSERT_TRUE(input->spec().getattribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8),
                                         chromaticities));
  const float expected[8] = {0.64F, 0.33F, 0.30F, 0.60F, 0.15F, 0.06F, 0.3127F, 0.3290F};
  for (int i = 0; i < 8; ++i) EXPECT_EQ(chromaticities[i], expected[i]);
  for (const auto& [name, text] : metadata) {
    EXPECT_EQ(input->spec().get_string_attribute(name), text);
  }
  EXPECT_EQ(input->spec().format, OIIO::TypeDesc::FLOAT);
}

TEST_F(ImageFile, PngKeepsMetadataAndSaysSrgb) {
  ASSERT_TRUE(write_image(noise(2, 2), folder_ / "a.png", false, {{"metamer:plan", "point"}}));
  const auto input = OIIO::ImageInput::open((folder_ / "a.png").string());
  ASSERT_TRUE(input);
  EXPECT_EQ(input->spec().get_string_attribute("metamer:plan"), "point");
  EXPECT_EQ(input->spec().get_string_attribute("oiio:ColorSpace"), "sRGB");
  EXPECT_EQ(input->spec().format, OIIO::TypeDesc::UINT8);
  EXPECT_EQ(input->spec().nchannels, 3);
}

TEST_F(ImageFile, PngRoundsToTheNearestOf256) {
  // Greys 0.49 of a step below and above each code.
  std::vector<srgb::Rgb> linear;
  for (int code = 0; code < 256; ++code) {
    for (const double off : {-0.49, 0.0, 0.49}) {
      const double value = srgb::decode(std::min(255.0, std::max(0.0, code + off)) / 255);
      linear.push_back({value, value, value});
    }
  }
  const auto report = write_image(row_of(linear), folder_ / "a.png", false, {});
  ASSERT_TRUE(report) << format(report.error());
  EXPECT_EQ(report->negative, 0U);
  EXPECT_EQ(report->above, 0U) << "f32's rounding of white is not out of gamut";
  const auto back = read_image(folder_ / "a.png");
  ASSERT_TRUE(back) << format(back.error());
  for (std::size_t i = 0; i < back->pixels.size(); ++i) {
    EXPECT_EQ(std::lround(back->pixels[i] * 255), static_cast<long>(i / 9)) << i;
  }
}

TEST_F(ImageFile, PngCountsThePixelsThatItClips) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Image image = row_of(
      {{0, 0, 0}, {1, 1, 1}, {-0.01, 0.5, -0.01}, {1.01, 0.5, 0.5}, {-1, 2, 0}, {nan, 0, 0}});
  const auto report = write_image(image, folder_ / "a.png", false, {});
  ASSERT_TRUE(report) << format(report.error());
  EXPECT_EQ(report->negative, 3U) << "the third, the fifth, the one that is not a number";
  EXPECT_EQ(report->above, 2U);
  const auto back = read_image(folder_ / "a.png");
  ASSERT_TRUE(back);
  EXPECT_EQ(back->at(2, 0)[0], 0.0F);
  EXPECT_EQ(back->at(3, 0)[0], 1.0F);
  EXPECT_EQ(back->at(4, 0)[1], 1.0F);
  EXPECT_EQ(back->at(5, 0)[0], 0.0F);
}

TEST_F(ImageFile, PngCountsNothingThatRoundingTo8BitsHides) {
  // Half a step above 255 is 1.0045 in linear light by the inverse of IEC 61966-2-1; below 0,
  // -1.52e-4.
  const auto hidden = write_image(row_of({{1.004, -1e-4, 0}}), folder_ / "a.png", false, {});
  ASSERT_TRUE(hidden);
  EXPECT_EQ(hidden->negative + hidden->above, 0U);
  const auto seen =
      write_image(row_of({{1.006, 0, 0}, {0, -2e-4, 0}}), folder_ / "a.png", false, {});
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->above, 1U);
  EXPECT_EQ(seen->negative, 1U);
}

TEST_F(ImageFile, PngCountsNoRoundingOfF32) {
  const auto report =
      write_image(row_of({{1 + 5e-7, -5e-7, 0}, {1, 1, 1}}), folder_ / "a.png", false, {});
  ASSERT_TRUE(report) << format(report.error());
  EXPECT_EQ(report->negative, 0U);
  EXPECT_EQ(report->above, 0U);
}

TEST_F(ImageFile, WritesNoOtherFormats) {
  const Image image = noise(2, 2);
  EXPECT_EQ(error_of(write_image(image, "a.tiff", false, {})),
            "a.tiff: error: pictures are written as .png or .exr, not as \".tiff\"");
  EXPECT_EQ(error_of(write_image(image, "picture", false, {})),
            "picture: error: pictures are written as .png or .exr, not as \"\"");
  EXPECT_EQ(error_of(write_image(image, "a.png", true, {})),
            "a.png: error: XYZ can only be written as .exr");
}

TEST_F(ImageFile, SaysWhyAFolderCantBeWritten) {
  const fs::path file = folder_ / "missing" / "a.png";
  EXPECT_EQ(error_of(write_image(noise(2, 2), file, false, {})),
            file.string() + ": error: can't be written: No such file or directory");
  fs::create_directory(folder_ / "taken.png");
  std::ofstream(folder_ / "taken.png" / "x") << "x";
  EXPECT_EQ(error_of(write_image(noise(2, 2), folder_ / "taken.png", false, {})),
            (folder_ / "taken.png").string() + ": error: can't be written: Is a directory");
  EXPECT_EQ(files(), std::vector<std::string>{"taken.png"}) << "nothing is left over";
}

TEST_F(ImageFile, ADiskThatFillsUpLeavesTheOlderPicture) {
  for (const char* name : {"a.png", "a.exr"}) {
    ASSERT_TRUE(write_image(noise(4, 4), folder_ / name, false, {}));
    const std::string before = slurp(folder_ / name);
    const std::size_t count = files().size();

    // Let files have 4 KiB; the picture needs more.
    rlimit old{};
    ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &old), 0);
    const auto handler = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small = {.rlim_cur = 4096, .rlim_max = old.rlim_max};
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
    const auto result = write_image(noise(100, 100), folder_ / name, false, {});
    ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &old), 0);
    std::signal(SIGXFSZ, handler);

    EXPECT_EQ(error_of(result),
              (folder_ / name).string() + ": error: can't be written: File too large");
    EXPECT_EQ(slurp(folder_ / name), before);
    EXPECT_EQ(files().size(), count) << "nothing is left over";
  }
}

TEST_F(ImageFile, ReplacesAnOlderPicture) {
  ASSERT_TRUE(write_image(noise(4, 4), folder_ / "a.png", false, {}));
  ASSERT_TRUE(write_image(noise(8, 4), folder_ / "a.png", false, {}));
  EXPECT_EQ(read_image(folder_ / "a.png")->width, 8);
  EXPECT_EQ(files(), std::vector<std::string>{"a.png"});
}

TEST_F(ImageFile, TheSamePictureIsTheSameBytes) {
  for (const char* extension : {".png", ".exr"}) {
    ASSERT_TRUE(write_image(noise(50, 80), folder_ / ("a" + std::string(extension)), false, {}));
    ASSERT_TRUE(write_image(noise(50, 80), folder_ / ("b" + std::string(extension)), false, {}));
    const std::string bytes = slurp(folder_ / ("a" + std::string(extension)));
    EXPECT_EQ(bytes, slurp(folder_ / ("b" + std::string(extension))));
    // Two pictures of one second would agree with the time in them, too.
    char today[16];
    const std::time_t now = std::time(nullptr);
    std::strftime(today, sizeof today, "%Y:%m:%d ", std::localtime(&now));
    EXPECT_EQ(bytes.find(today), std::string::npos) << extension;
  }
}

std::string read_error(const fs::path& file) {
  const auto result = read_image(file);
  return result ? "no error" : format(result.error());
}

TEST_F(ImageFile, ReadsOnlyWhatIsThere) {
  EXPECT_EQ(read_error(folder_ / "a.png"), (folder_ / "a.png").string() + ": error: no such file");
  EXPECT_EQ(read_error("a.jpg"),
            "a.jpg: error: pictures are read from .png or .exr, not from \".jpg\"");
}

TEST_F(ImageFile, BrokenPicturesAreErrors) {
  for (const char* name : {"a.png", "a.exr"}) {
    ASSERT_TRUE(write_image(noise(50, 80), folder_ / name, false, {}));
    const std::string whole = slurp(folder_ / name);
    for (const std::size_t size :
         {std::size_t{0}, std::size_t{3}, std::size_t{20}, whole.size() / 10, whole.size() / 2}) {
      std::ofstream(folder_ / name, std::ios::binary) << whole.substr(0, size);
      const std::string start = (folder_ / name).string() + ": error: can't read the picture: ";
      EXPECT_EQ(read_error(folder_ / name).substr(0, start.size()), start) << size;
    }
  }
}

/// A chunk of a PNG file: length, name, data, CRC-32.
std::string png_chunk(const std::string& name, const std::string& data) {
  const auto big_endian = [](std::uint32_t number) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(number >> shift & 0xFF);
    return bytes;
  };
  std::uint32_t crc = 0xFFFFFFFF;
  for (const char c : name + data) {
    crc ^= static_cast<unsigned char>(c);
    for (int bit = 0; bit < 8; ++bit) crc = crc >> 1 ^ (crc & 1 ? 0xEDB88320 : 0);
  }
  return big_endian(static_cast<std::uint32_t>(data.size())) + name + data + big_endian(~crc);
}

TEST_F(ImageFile, AHeaderThatAsksForTooMuchIsRefused) {
  const std::string size("\0\0\xEA\x60", 4);    // 60000
  const std::string rest("\x08\x02\0\0\0", 5);  // 8 bits, RGB
  std::ofstream(folder_ / "a.png", std::ios::binary)
      << "\x89PNG\r\n\x1A\n"
      << png_chunk("IHDR", size + size + rest) << png_chunk("IDAT", "x");
  EXPECT_EQ(read_error(folder_ / "a.png"),
            (folder_ / "a.png").string() +
                ": error: the picture is too large: 60000 × 60000 × 3 values, at most 268435456");
}

TEST_F(ImageFile, AShortFileAsksForNoMoreThanItCanHold) {
  const std::string size("\0\0\x20\0", 4);  // 8192
  const std::string rest("\x08\x02\0\0\0", 5);
  std::ofstream(folder_ / "a.png", std::ios::binary)
      << "\x89PNG\r\n\x1A\n"
      << png_chunk("IHDR", size + size + rest) << png_chunk("IDAT", "x");
  EXPECT_EQ(
      read_error(folder_ / "a.png"),
      (folder_ / "a.png").string() +
          ": error: can't read the picture: it is cut short, or its size is wrong: 8192 × 8192 "
          "pixels can't be in it");
  // Black by the best that deflate can do, 1032 to 1, is still read.
  const std::vector<std::uint8_t> black(std::size_t{3} * 4096 * 4096);
  ASSERT_TRUE(write_rgb(4096, 4096, black, folder_ / "b.png", {}));
  EXPECT_TRUE(read_image(folder_ / "b.png"));
}

TEST_F(ImageFile, NothingStartsThreads) {
  const auto threads = [] {
    std::size_t count = 0;
    for (const auto& task : fs::directory_iterator("/proc/self/task"))
      count += !task.path().empty();
    return count;
  };
  const std::size_t before = threads();
  ASSERT_TRUE(write_image(noise(500, 500), folder_ / "a.exr", false, {}));
  ASSERT_TRUE(write_image(noise(500, 500), folder_ / "a.png", false, {}));
  ASSERT_TRUE(read_image(folder_ / "a.exr"));
  ASSERT_TRUE(read_image(folder_ / "a.png"));
  EXPECT_EQ(threads(), before);
}

}  // namespace
}  // namespace metamer
