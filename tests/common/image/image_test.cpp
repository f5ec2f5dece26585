#include "common/image/image.h"

#include <OpenImageIO/imageio.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <limits>
#include <random>

#include "common/color/adaptation.h"
#include "common/color/srgb.h"
#include "image_file.h"

// OpenImageIO's PNG reader leaks the text of each error: libpng jumps out of the call that holds
// it. Often the leak checker sees no more of that call than libstdc++'s assignment.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
  return "leak:ImageInput::geterror\nleak:basic_string*_M_assign\n";
}

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
  const Image expected = to_linear_srgb(image);
  EXPECT_EQ(back->channels, (std::vector<std::string>{"R", "G", "B"}));
  EXPECT_TRUE(same_bits(back->pixels, expected.pixels));

  // And that is the matrix applied to each pixel.
  for (int x = 0; x < 70; ++x) {
    const float* xyz = image.at(x, 69);
    const srgb::Rgb rgb = srgb::from_xyz({xyz[0], xyz[1], xyz[2]});
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_EQ(back->at(x, 69)[c], static_cast<float>(rgb[c]));
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

/// Big-endian numbers of a profile, ICC.1:2010, 4.
std::uint32_t u32(const std::string& bytes, std::size_t at) {
  std::uint32_t number = 0;
  for (std::size_t i = 0; i < 4; ++i)
    number = number << 8 | static_cast<unsigned char>(bytes.at(at + i));
  return number;
}

/// The s15Fixed16Numbers of a profile's element, behind its first `skip` bytes.
std::vector<double> element(const std::string& profile, const std::string& name, std::size_t skip) {
  for (std::size_t i = 0; i < u32(profile, 128); ++i) {
    const std::size_t entry = 132 + 12 * i;
    if (profile.substr(entry, 4) != name) continue;
    std::vector<double> numbers;
    for (std::size_t at = skip; at < u32(profile, entry + 8); at += 4)
      numbers.push_back(static_cast<std::int32_t>(u32(profile, u32(profile, entry + 4) + at)) /
                        65536.0);
    return numbers;
  }
  ADD_FAILURE() << "no " << name;
  return {};
}

std::string profile_of(const fs::path& file) {
  const auto input = OIIO::ImageInput::open(file.string());
  const auto* found = input ? input->spec().find_attribute("ICCProfile") : nullptr;
  if (found == nullptr) return {};
  return {static_cast<const char*>(found->data()), found->type().size()};
}

TEST_F(ImageFile, PngOfAnotherSpaceSaysWhatItsNumbersMean) {
  Developing wide;
  wide.space = rgb_space(StandardSpace::display_p3);
  ASSERT_TRUE(write_image(noise(2, 2), folder_ / "a.png", false, {}, wide));
  const std::string profile = profile_of(folder_ / "a.png");
  ASSERT_EQ(u32(profile, 0), profile.size());
  // The profile that Apple ships has these colorants, adapted to D50 by Bradford.
  const std::pair<const char*, std::vector<double>> colorants[] = {
      {"rXYZ", {0.5151, 0.2412, -0.0011}},
      {"gXYZ", {0.2920, 0.6922, 0.0419}},
      {"bXYZ", {0.1571, 0.0666, 0.7841}}};
  for (const auto& [name, published] : colorants) {
    const std::vector<double> own = element(profile, name, 8);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(own.at(c), published[c], 2e-4) << name;
  }
  // The curve of sRGB: gamma, a, b, c, d.
  const std::vector<double> curve = element(profile, "rTRC", 12);
  const double expected[] = {2.4, 1 / 1.055, 0.055 / 1.055, 1 / 12.92, 0.04045};
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(curve.at(i), expected[i], 1e-5);

  // Linear sRGB is another space, too; sRGB itself needs no profile.
  Developing linear;
  linear.linear = true;
  ASSERT_TRUE(write_image(noise(2, 2), folder_ / "b.png", false, {}, linear));
  EXPECT_EQ(element(profile_of(folder_ / "b.png"), "gTRC", 12).at(0), 1);
  ASSERT_TRUE(write_image(noise(2, 2), folder_ / "c.png", false, {}));
  EXPECT_EQ(profile_of(folder_ / "c.png"), "");
}

TEST_F(ImageFile, PngHoldsTheCodeValuesOfItsSpace) {
  const RgbSpace& space = rgb_space(StandardSpace::adobe_rgb);
  Image image = make_image(3, 1, {"X", "Y", "Z"});
  const Rgb colors[] = {{0.2, 0.5, 0.8}, {1, 1, 1}, {-0.1, 0.5, 1.2}};
  for (int x = 0; x < 3; ++x) {
    const Xyz xyz = multiply(space.to_xyz, colors[x]);
    for (std::size_t c = 0; c < 3; ++c) image.at(x, 0)[c] = static_cast<float>(xyz[c]);
  }
  for (const bool linear : {false, true}) {
    Developing developing;
    developing.space = space;
    developing.linear = linear;
    const auto report = write_image(image, folder_ / "a.png", false, {}, developing);
    ASSERT_TRUE(report);
    EXPECT_EQ(report->negative, 1U);
    EXPECT_EQ(report->above, 1U);
    const auto back = read_image(folder_ / "a.png");
    ASSERT_TRUE(back);
    for (std::size_t c = 0; c < 3; ++c) {
      const double code = linear ? colors[0][c] : std::pow(colors[0][c], 256.0 / 563);
      EXPECT_EQ(std::lround(255 * back->at(0, 0)[c]), std::lround(255 * code));
      EXPECT_EQ(back->at(1, 0)[c], 1.0F);
    }
  }
}

TEST_F(ImageFile, ExrIsLinearInItsSpaceAndAdapted) {
  Developing developing;
  developing.space = rgb_space(StandardSpace::prophoto);
  const Xyz tinted = {1.0985, 1, 0.3558};
  developing.adaptation =
      *adaptation_matrix(Adaptation::bradford, tinted, white_xyz(developing.space.primaries.white));
  Image image = make_image(1, 1, {"X", "Y", "Z"});
  for (std::size_t c = 0; c < 3; ++c) image.pixels[c] = static_cast<float>(0.5 * tinted[c]);
  ASSERT_TRUE(write_image(image, folder_ / "a.exr", false, {}, developing));
  const auto back = read_image(folder_ / "a.exr");
  ASSERT_TRUE(back);
  for (const float value : back->pixels) EXPECT_NEAR(value, 0.5, 1e-6) << "grey stays grey";

  const auto input = OIIO::ImageInput::open((folder_ / "a.exr").string());
  float own[8] = {};
  ASSERT_TRUE(
      input->spec().getattribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8), own));
  const float expected[8] = {0.7347F, 0.2653F, 0.1596F, 0.8404F,
                             0.0366F, 0.0001F, 0.3457F, 0.3585F};
  for (int i = 0; i < 8; ++i) EXPECT_EQ(own[i], expected[i]);
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
    EXPECT_EQ(slurp(folder_ / ("a" + std::string(extension))),
              slurp(folder_ / ("b" + std::string(extension))));
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
  testing::internal::CaptureStderr();  // libpng writes there by itself.
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
  testing::internal::GetCapturedStderr();
  EXPECT_EQ(OIIO::geterror(), "") << "no error is left for somebody else to find";
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
