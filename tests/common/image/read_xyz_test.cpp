#include "common/image/read_xyz.h"

#include <OpenImageIO/imageio.h>

#include "common/color/lab.h"
#include "common/color/srgb.h"
#include "common/color/xyz.h"
#include "common/image/spectral_exr.h"
#include "image_file.h"

namespace metamer {
namespace {

using ReadXyz = ImageFile;

/// One pixel with these channels.
void write_pixel(const std::filesystem::path& file, const std::vector<std::string>& names,
                 const std::vector<float>& values, const std::vector<float>& chromaticities = {}) {
  OIIO::ImageSpec spec(1, 1, static_cast<int>(names.size()),
                       file.extension() == ".png" ? OIIO::TypeDesc::UINT8 : OIIO::TypeDesc::FLOAT);
  spec.channelnames = names;
  if (!chromaticities.empty())
    spec.attribute("chromaticities", OIIO::TypeDesc(OIIO::TypeDesc::FLOAT, 8),
                   chromaticities.data());
  const auto output = OIIO::ImageOutput::create(file.string());
  ASSERT_TRUE(output->open(file.string(), spec)) << output->geterror();
  ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, values.data()));
  ASSERT_TRUE(output->close());
}

void expect_xyz(const Result<XyzPicture>& picture, const Xyz& expected, double within) {
  ASSERT_TRUE(picture) << format(picture.error());
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(picture->image.at(0, 0)[c], expected[c], within) << c;
}

TEST_F(ReadXyz, DecodesAPng) {
  write_pixel(folder_ / "a.png", {"R", "G", "B"}, {1, 0, 188 / 255.0F});
  expect_xyz(read_xyz(folder_ / "a.png", {}), srgb::to_xyz({1, 0, srgb::decode(188 / 255.0)}),
             1e-6);
  write_pixel(folder_ / "grey.png", {"Y"}, {188 / 255.0F});
  const double grey = srgb::decode(188 / 255.0);
  expect_xyz(read_xyz(folder_ / "grey.png", {}), srgb::to_xyz({grey, grey, grey}), 1e-6);
}

TEST_F(ReadXyz, TakesXYZAsTheyAre) {
  write_pixel(folder_ / "a.exr", {"Z", "Y", "A", "X"}, {3, 2, 0.5F, 1});
  expect_xyz(read_xyz(folder_ / "a.exr", {}), {1, 2, 3}, 0);
}

TEST_F(ReadXyz, GoesByTheFilesChromaticities) {
  // The red primary of Rec. 2020 (ITU-R BT.2020): x 0.708, y 0.292, and the luminance 0.2627.
  const std::vector<float> rec_2020 = {0.708F, 0.292F, 0.170F,  0.797F,
                                       0.131F, 0.046F, 0.3127F, 0.3290F};
  write_pixel(folder_ / "a.exr", {"R", "G", "B"}, {1, 0, 0}, rec_2020);
  const double y = 0.2627;
  expect_xyz(read_xyz(folder_ / "a.exr", {}), {0.708 / 0.292 * y, y, 0}, 1e-4);
  // Its white is that of sRGB; and without any chromaticities RGB is sRGB.
  write_pixel(folder_ / "b.exr", {"R", "G", "B"}, {1, 1, 1}, rec_2020);
  expect_xyz(read_xyz(folder_ / "b.exr", {}), srgb::to_xyz({1, 1, 1}), 1e-5);
  write_pixel(folder_ / "c.exr", {"R", "G", "B"}, {0.2F, 0.4F, 0.6F});
  expect_xyz(read_xyz(folder_ / "c.exr", {}), srgb::to_xyz({0.2, 0.4, 0.6}), 1e-6);
}

/// One pixel of a spectrum.
void write_spectrum(const std::filesystem::path& file, bool reflectance, std::vector<double> nm,
                    const std::vector<double>& values) {
  const SpectralImage image{.width = 1,
                            .height = 1,
                            .reflectance = reflectance,
                            .nm = std::move(nm),
                            .values = {values.begin(), values.end()},
                            .units = {},
                            .polarised = false};
  ASSERT_TRUE(write_spectral_exr(image, make_image(1, 1, {"X", "Y", "Z"}), file, {}));
}

TEST_F(ReadXyz, LightsAReflectanceBetweenItsBands) {
  // F11's lines lie between bands of 20 nm. numpy over 0.005 nm, of straight lines between bands.
  const auto nm = Wavelengths::uniform(400, 700, 20)->nm();
  for (const auto& [name, xyz] : {std::pair{"TCS09", Xyz{0.24162607, 0.13444837, 0.02670481}},
                                  std::pair{"TCS01", Xyz{0.36729376, 0.31041207, 0.14540323}}}) {
    write_spectrum(folder_ / "a.exr", true, nm,
                   resample(*cie::test_color(name), nm, Outside::hold).values);
    expect_xyz(read_xyz(folder_ / "a.exr", {.under = cie::illuminant("F11")}), xyz, 1e-6);
  }
  // Their difference by the same numpy; with a white of other weights it was 41.4.
  const Xyz f11 = white_of(*cie::illuminant("F11"), cie::observer_1931());
  const auto lab = [&](const char* name) {
    write_spectrum(folder_ / "a.exr", true, nm,
                   resample(*cie::test_color(name), nm, Outside::hold).values);
    const auto read = read_xyz(folder_ / "a.exr", {.under = cie::illuminant("F11")});
    const float* pixel = read->image.at(0, 0);
    return to_lab({pixel[0], pixel[1], pixel[2]}, f11);
  };
  EXPECT_NEAR(delta_e_00(lab("TCS09"), lab("TCS01")), 23.335, 2e-3);
  // White is white, whatever the bands.
  write_spectrum(folder_ / "a.exr", true, {460, 470, 600}, {1, 1, 1});
  expect_xyz(read_xyz(folder_ / "a.exr", {.under = cie::illuminant("F11")}),
             white_of(*cie::illuminant("F11"), cie::observer_1931()), 1e-6);
}

TEST_F(ReadXyz, TakesAnEmissionForBandMeans) {
  const auto nm = Wavelengths::uniform(360, 830, 10)->nm();
  // A straight line is seen as its integral.
  const Spectrum line{{360, 830}, {1, 3}};
  write_spectrum(folder_ / "a.exr", false, nm, resample(line, nm, Outside::zero).values);
  const Xyz whole = emission_xyz(line, cie::observer_1931());
  expect_xyz(read_xyz(folder_ / "a.exr", {}), whole, 1e-4);
  // F11, whose samples at those bands are ΔE00 11.3 off, is 0.10 off by numpy.
  const Spectrum& lamp = *cie::illuminant("F11");
  write_spectrum(folder_ / "a.exr", false, nm, band_means(lamp, nm));
  const auto read = read_xyz(folder_ / "a.exr", {});
  ASSERT_TRUE(read);
  const Xyz white = white_of(lamp, cie::observer_1931());
  const double y = emission_xyz(lamp, cie::observer_1931())[1];
  const float* pixel = read->image.at(0, 0);
  EXPECT_NEAR(
      delta_e_00(to_lab({pixel[0] / y, pixel[1] / y, pixel[2] / y}, white), to_lab(white, white)),
      0.104, 0.005);
}

TEST_F(ReadXyz, RefusesWhatHasNoColourToTell) {
  const auto refused = [&](const char* name) {
    const auto picture = read_xyz(folder_ / name, {});
    return picture ? "none" : picture.error().message;
  };
  write_pixel(folder_ / "a.exr", {"Z"}, {1});
  EXPECT_EQ(refused("a.exr"),
            "the picture has neither X Y Z nor R G B nor a spectrum; its channels are \"Z\"");
  write_pixel(folder_ / "b.exr", {"R", "G", "B"}, {1, 1, 1}, std::vector<float>(8, 0.3F));
  EXPECT_EQ(refused("b.exr"),
            "its chromaticities make no RGB space: red, green and blue must not lie on a line");
  write_pixel(folder_ / "c.exr", {"R", "G", "B"}, {1, 1, 1}, std::vector<float>(8, 0.0F));
  EXPECT_EQ(refused("c.exr"),
            "its chromaticities make no RGB space: red must have a y other than 0 (it is 0)");
  EXPECT_EQ(refused("nowhere.png"), "no such file");
  EXPECT_EQ(refused("a.jpg"), "pictures are read from .png or .exr, not from \".jpg\"");
}

}  // namespace
}  // namespace metamer
