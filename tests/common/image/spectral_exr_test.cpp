#include "common/image/spectral_exr.h"

#include <OpenImageIO/imageio.h>

#include <cmath>
#include <cstdio>

#include "common/color/srgb.h"
#include "common/image/read_xyz.h"
#include "image_file.h"

namespace metamer {
namespace {

/// Wavelengths of two to four digits before the point: the alphabet orders them otherwise.
SpectralImage some_spectra(bool reflectance = false) {
  SpectralImage image;
  image.width = 3;
  image.height = 70;  // more rows than are converted at a time
  image.reflectance = reflectance;
  image.nm = {99.5, 400, 550, 700.25, 1000};
  for (std::size_t i = 0; i < 3 * 70 * 5; ++i)
    image.values.push_back(std::sin(static_cast<float>(i)));
  return image;
}

Image grey_preview(const SpectralImage& image) {
  Image preview = make_image(image.width, image.height, {"X", "Y", "Z"});
  const Xyz grey = srgb::to_xyz({0.5, 0.5, 0.5});
  for (std::size_t i = 0; i < preview.pixels.size(); ++i)
    preview.pixels[i] = static_cast<float>(grey[i % 3]);
  return preview;
}

std::string said_by(const std::string& command) {
  std::string text;
  FILE* pipe = ::popen((command + " 2>&1").c_str(), "r");
  if (!pipe) return text;
  std::array<char, 4096> some{};
  while (const std::size_t count = std::fread(some.data(), 1, some.size(), pipe))
    text.append(some.data(), count);
  ::pclose(pipe);
  return text;
}

/// An EXR of one pixel with these channels, all 1.
void write_channels(const std::filesystem::path& file, const std::vector<std::string>& names,
                    const std::string& units = "") {
  OIIO::ImageSpec spec(1, 1, static_cast<int>(names.size()), OIIO::TypeDesc::FLOAT);
  spec.channelnames = names;
  if (!units.empty()) spec.attribute("emissiveUnits", units);
  const auto output = OIIO::ImageOutput::create("exr");
  ASSERT_TRUE(output->open(file.string(), spec)) << output->geterror();
  const std::vector<float> ones(names.size(), 1.0F);
  ASSERT_TRUE(output->write_image(OIIO::TypeDesc::FLOAT, ones.data()));
  ASSERT_TRUE(output->close());
}

using SpectralExr = ImageFile;

TEST_F(SpectralExr, SaysToOpenexrWhatTheLayoutDemands) {
  const SpectralImage image = some_spectra();
  const auto file = folder_ / "a.exr";
  const auto written =
      write_spectral_exr(image, grey_preview(image), file, {{"metamer:scene", "s"}});
  ASSERT_TRUE(written) << format(written.error());
  const std::string header = said_by("exrheader " + file.string());
  for (const char* line :
       {"spectralLayoutVersion (type string): \"1.0\"",
        "emissiveUnits (type string): \"W.m^-2.sr^-1\"", "EV (type float): 0",
        "metamer:scene (type string): \"s\"", "metamer:bands (type string): ",
        "Y = 1 is 683 cd/m^2", "S0.99,500000nm, 32-bit floating-point",
        "S0.550,000000nm, 32-bit floating-point", "S0.1000,000000nm, 32-bit floating-point",
        "R, 32-bit floating-point", "red   (0.64 0.33)", "white (0.3127 0.329)"})
    EXPECT_NE(header.find(line), std::string::npos) << line << " is not in\n" << header;
}

TEST_F(SpectralExr, OfReflectancesHasChannelsTAndNoEmissiveUnits) {
  const SpectralImage image = some_spectra(true);
  const auto file = folder_ / "a.exr";
  ASSERT_TRUE(write_spectral_exr(image, grey_preview(image), file, {}));
  const std::string header = said_by("exrheader " + file.string());
  EXPECT_NE(header.find("T.550,000000nm, 32-bit floating-point"), std::string::npos) << header;
  EXPECT_EQ(header.find("S0."), std::string::npos);
  EXPECT_EQ(header.find("emissiveUnits"), std::string::npos);
}

TEST_F(SpectralExr, ComesBackBitForBitInTheOrderOfWavelengths) {
  for (const bool reflectance : {false, true}) {
    const SpectralImage image = some_spectra(reflectance);
    ASSERT_TRUE(write_spectral_exr(image, grey_preview(image), folder_ / "a.exr", {}));
    const auto back = read_spectral_exr(folder_ / "a.exr");
    ASSERT_TRUE(back) << format(back.error());
    ASSERT_TRUE(*back);
    EXPECT_EQ((*back)->nm, image.nm);
    EXPECT_EQ((*back)->values, image.values);
    EXPECT_EQ((*back)->width, 3);
    EXPECT_EQ((*back)->height, 70);
    EXPECT_EQ((*back)->reflectance, reflectance);
    EXPECT_EQ((*back)->units, reflectance ? "" : radiance_units);
    EXPECT_FALSE((*back)->polarised);
  }
}

TEST_F(SpectralExr, ShowsItsPreviewToProgramsThatKnowRgbAlone) {
  const SpectralImage image = some_spectra();
  ASSERT_TRUE(write_spectral_exr(image, grey_preview(image), folder_ / "a.exr", {}));
  const auto back = read_image(folder_ / "a.exr");
  ASSERT_TRUE(back);
  ASSERT_EQ(back->channels[0], "R");
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(back->at(2, 69)[c], 0.5, 1e-6);
}

TEST_F(SpectralExr, ByOthersIsReadInTheirSpelling) {
  write_channels(folder_ / "a.exr", {"S0.0,7um", "S0.550nm", "S1.550nm", "S0.540THz"}, "W/m^2/sr");
  const auto read = read_spectral_exr(folder_ / "a.exr");
  ASSERT_TRUE(read) << format(read.error());
  ASSERT_EQ((*read)->nm.size(), 3u);
  EXPECT_EQ((*read)->nm[0], 550);
  EXPECT_NEAR((*read)->nm[1], 555.171, 1e-3);
  EXPECT_DOUBLE_EQ((*read)->nm[2], 700);
  EXPECT_EQ((*read)->units, radiance_units);
  EXPECT_TRUE((*read)->polarised);
}

TEST_F(SpectralExr, WithoutASpectrumIsNothingAndNoError) {
  write_channels(folder_ / "a.exr", {"R", "G", "B", "depth"});
  const auto read = read_spectral_exr(folder_ / "a.exr");
  ASSERT_TRUE(read);
  EXPECT_FALSE(*read);
}

TEST_F(SpectralExr, ThatIsHostileIsRefusedByName) {
  const auto file = folder_ / "a.exr";
  const auto refused = [&](const std::vector<std::string>& names) {
    write_channels(file, names);
    const auto read = read_spectral_exr(file);
    return read ? "none" : format(read.error());
  };
  const std::string start = file.string() + ": error: ";
  EXPECT_EQ(refused({"S0.,nm"}), start + "channel \"S0.,nm\": \",nm\" is not a number and a unit");
  EXPECT_EQ(
      refused({"S0.1e400nm"}),
      start + "channel \"S0.1e400nm\": the wavelength \"1e400nm\" must be finite and above 0");
  EXPECT_EQ(refused({"S0.550nm", "S0.550,0nm"}),
            start + "channels \"S0.550,0nm\" and \"S0.550nm\" are both at 550 nm");
  EXPECT_EQ(refused({"S0.550nm", "T.550nm"}),
            start + "the picture has an emission (S0.) and a reflectance (T.) as well");
  EXPECT_EQ(refused({"S2.550nm"}), start + "the picture has channels S1. to S3., but no S0.");
  std::vector<std::string> many;
  for (int i = 0; i < 4002; ++i) many.push_back("S0." + std::to_string(300 + i) + "nm");
  EXPECT_EQ(refused(many), start + "the picture has 4002 wavelengths, at most 4001 are possible");
}

TEST_F(SpectralExr, IsNotWrittenWhereNamesWouldCollideOrAsPng) {
  SpectralImage image = some_spectra();
  image.nm[1] = image.nm[0] + 1e-8;
  const auto written = write_spectral_exr(image, grey_preview(image), folder_ / "a.exr", {});
  ASSERT_FALSE(written);
  EXPECT_EQ(written.error().message,
            "two wavelengths are too close for the channel name \"S0.99,500000nm\"");
  EXPECT_FALSE(write_spectral_exr(image, grey_preview(image), folder_ / "a.png", {}));
  EXPECT_TRUE(files().empty());
}

TEST_F(SpectralExr, OfAWhiteReflectanceHasItsLightsWhite) {
  // Under E every nm weighs the same: X = Σ x̄ / Σ ȳ.
  SpectralImage image;
  image.width = image.height = 1;
  image.reflectance = true;
  for (int nm = 360; nm <= 830; ++nm) image.nm.push_back(nm);
  image.values.assign(image.nm.size(), 1.0F);
  ASSERT_TRUE(write_spectral_exr(image, grey_preview(image), folder_ / "a.exr", {}));
  EXPECT_FALSE(read_xyz(folder_ / "a.exr", {})) << "nothing lights it";
  for (const char* name : {"E", "A", "F11"}) {
    Viewing viewing;
    viewing.under = cie::illuminant(name);
    const auto picture = read_xyz(folder_ / "a.exr", viewing);
    ASSERT_TRUE(picture) << format(picture.error());
    EXPECT_TRUE(picture->lit);
    EXPECT_EQ(picture->what, "a reflectance at 471 wavelengths");
    EXPECT_NEAR(picture->image.at(0, 0)[1], 1, 1e-6) << name;
  }
  // CIE 15:2004, table T.3: the white of A is X 109.850, Z 35.585.
  Viewing under_a;
  under_a.under = cie::illuminant("A");
  const auto picture = read_xyz(folder_ / "a.exr", under_a);
  EXPECT_NEAR(picture->image.at(0, 0)[0], 1.0985, 2e-4);
  EXPECT_NEAR(picture->image.at(0, 0)[2], 0.35585, 2e-4);
}

TEST_F(SpectralExr, OfAnEmissionIsSeenByTheObserverAskedFor) {
  // Light in one band alone: X : Y : Z is x̄ : ȳ : z̄ there (CIE 1931: 0.2904, 0.954, 0.0203 at
  // 540), but for what these bend over a band.
  SpectralImage image;
  image.width = image.height = 1;
  image.nm = {535, 540, 545};
  image.values = {0, 2, 0};
  ASSERT_TRUE(write_spectral_exr(image, grey_preview(image), folder_ / "a.exr", {}));
  const auto seen = read_xyz(folder_ / "a.exr", {});
  ASSERT_TRUE(seen);
  EXPECT_NEAR(seen->image.at(0, 0)[0], 0.2904 * 2 * 5, 0.012);
  EXPECT_NEAR(seen->image.at(0, 0)[1], 0.954 * 2 * 5, 0.012);
  EXPECT_NEAR(seen->image.at(0, 0)[2], 0.0203 * 2 * 5, 0.012);
  const auto wide = read_xyz(folder_ / "a.exr", {.observer = cie::observer_1964()});
  ASSERT_TRUE(wide);
  EXPECT_NEAR(wide->image.at(0, 0)[0], 0.376772 * 2 * 5, 0.012);
}

}  // namespace
}  // namespace metamer
