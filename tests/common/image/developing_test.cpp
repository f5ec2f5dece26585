// Pictures in other spaces than sRGB, and what their files say of that.
#include <OpenImageIO/imageio.h>

#include <cmath>
#include <cstdint>

#include "common/color/adaptation.h"
#include "common/image/image.h"
#include "common/image/read_xyz.h"
#include "image_file.h"

namespace metamer {
namespace {

namespace fs = std::filesystem;

Image black() { return make_image(2, 2, {"X", "Y", "Z"}); }

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
  ASSERT_TRUE(write_image(black(), folder_ / "a.png", false, {}, wide));
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
  ASSERT_TRUE(write_image(black(), folder_ / "b.png", false, {}, linear));
  EXPECT_EQ(element(profile_of(folder_ / "b.png"), "gTRC", 12).at(0), 1);
  ASSERT_TRUE(write_image(black(), folder_ / "c.png", false, {}));
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

TEST_F(ImageFile, APngOfAnotherSpaceIsReadInThatSpace) {
  // The red primary of Display P3 (SMPTE RP 431-2): x 0.680, y 0.320.
  Image image = make_image(1, 1, {"X", "Y", "Z"});
  const double y = 0.2;
  const double red[] = {0.680 / 0.320 * y, y, 0};
  for (std::size_t c = 0; c < 3; ++c) image.pixels[c] = static_cast<float>(red[c]);
  for (const bool linear : {false, true}) {
    Developing wide;
    wide.space = rgb_space(StandardSpace::display_p3);
    wide.linear = linear;
    ASSERT_TRUE(write_image(image, folder_ / "a.png", false, {}, wide));
    const auto back = read_xyz(folder_ / "a.png", {});
    ASSERT_TRUE(back) << format(back.error());
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(back->image.pixels[c], red[c], 3e-3);
  }
}

TEST_F(ImageFile, APngOf16BitsRoundsToTheNearestOf65536) {
  // Greys 0.49 of a step beside codes, of every space and of its linear values.
  for (const std::string& word : rgb_space_words()) {
    for (const bool linear : {false, true}) {
      Developing developing;
      developing.space = *find_rgb_space(word);
      developing.linear = linear;
      developing.bits = 16;
      const std::vector<double> codes = {0, 1, 255, 256, 12345.49, 12344.51, 65534.51, 65535.4};
      Image image = make_image(static_cast<int>(codes.size()), 1, {"X", "Y", "Z"});
      for (std::size_t i = 0; i < codes.size(); ++i) {
        const double value =
            linear ? codes[i] / 65535 : decode(developing.space.transfer, codes[i] / 65535);
        const Xyz xyz = multiply(developing.space.to_xyz, Rgb{value, value, value});
        for (std::size_t c = 0; c < 3; ++c) image.pixels[3 * i + c] = static_cast<float>(xyz[c]);
      }
      const auto report = write_image(image, folder_ / "a.png", false, {}, developing);
      ASSERT_TRUE(report);
      EXPECT_EQ(report->above, 0U) << word << ": rounding hides 0.4 of a step";
      const auto input = OIIO::ImageInput::open((folder_ / "a.png").string());
      EXPECT_EQ(input->spec().format, OIIO::TypeDesc::UINT16);
      const auto back = read_image(folder_ / "a.png");
      for (std::size_t i = 0; i < codes.size(); ++i) {
        const long expected = std::min(65535L, std::lround(codes[i]));
        EXPECT_EQ(std::lround(65535 * back->pixels[3 * i + 1]), expected) << word << linear;
      }
    }
  }
}

TEST_F(ImageFile, APngOf16BitsComesBackCloserThanOneOf8) {
  Developing developing;
  developing.space = rgb_space(StandardSpace::rec_2020);
  Image image = make_image(64, 1, {"X", "Y", "Z"});
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = 0.2F + 0.003F * static_cast<float>(i % 64);
  for (const auto& [bits, within] : {std::pair(8, 4e-3), std::pair(16, 3e-5)}) {
    developing.bits = bits;
    ASSERT_TRUE(write_image(image, folder_ / "a.png", false, {}, developing));
    const auto back = read_xyz(folder_ / "a.png", {});
    ASSERT_TRUE(back) << format(back.error());
    EXPECT_EQ(back->what, "the ICC profile \"Rec. 2020\"");
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
      EXPECT_NEAR(back->image.pixels[i], image.pixels[i], within) << bits;
  }
}

}  // namespace
}  // namespace metamer
