// A pixel of a spectral EXR is a spectrum, whether the EXR is a file or bytes.
#include "common/image/pixel_spectrum.h"

#include <fstream>
#include <iterator>

#include "common/image/spectral_exr.h"
#include "image_file.h"

namespace metamer {
namespace {

class PixelSpectrum : public ImageFile {
 protected:
  void SetUp() override {
    ImageFile::SetUp();
    image.width = 5;
    image.height = 70;
    image.reflectance = true;
    image.nm = {400, 500, 600.5};
    for (std::size_t i = 0; i < 5 * 70 * 3; ++i)
      image.values.push_back(static_cast<float>(i) / 1024.0F);
    file = folder_ / "a.EXR";
    ASSERT_TRUE(write_spectral_exr(image, make_image(5, 70, {"X", "Y", "Z"}), file, {}));
    std::ifstream stream(file, std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(stream), {});
  }

  SpectralImage image;
  std::filesystem::path file;
  std::string bytes;
};

TEST_F(PixelSpectrum, IsWhatThePictureHasThere) {
  for (const PictureSource& source : {PictureSource(file), PictureSource(bytes, "b.exr")}) {
    const auto one = read_pixel_spectrum(source, "4x69");
    ASSERT_TRUE(one) << one.error().message;
    EXPECT_EQ(one->quantity, Quantity::reflectance);
    ASSERT_EQ(one->spectra.size(), 1u);
    EXPECT_EQ(one->spectra[0].name, "4x69");
    EXPECT_EQ(one->spectra[0].spectrum.nm, image.nm);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(one->spectra[0].spectrum.values[k], image.values[(69 * 5 + 4) * 3 + k]);
    // Corners in any order; 6 pixels of rows 63 to 65, which are read in pieces.
    const auto mean = read_pixel_spectrum(source, "3x65-2x63");
    ASSERT_TRUE(mean) << mean.error().message;
    for (std::size_t k = 0; k < 3; ++k) {
      double sum = 0;
      for (std::size_t y = 63; y <= 65; ++y)
        for (std::size_t x = 2; x <= 3; ++x) sum += image.values[(y * 5 + x) * 3 + k];
      EXPECT_NEAR(mean->spectra[0].spectrum.values[k], sum / 6, 1e-12);
    }
  }
}

TEST_F(PixelSpectrum, SaysWhatIsWrongWithAnEntry) {
  const PictureSource source(bytes, "b.exr");
  EXPECT_EQ(read_pixel_spectrum(source, "5x0").error().message,
            "has no pixel there: it has 5 by 70");
  EXPECT_EQ(read_pixel_spectrum(source, "0x70").error().file, "b.exr");
  EXPECT_FALSE(read_pixel_spectrum(source, std::nullopt));
  for (const std::string entry :
       {"", "1", "1,2", "-1x2", "1x2-", "1x2-3x4-", "99999999999x0", "1x2 "})
    EXPECT_EQ(read_pixel_spectrum(source, entry).error().message.substr(0, 34),
              "is a picture: an entry names a pix")
        << entry;
}

TEST_F(PixelSpectrum, DamagedBytesAreErrorsOrValues) {
  for (std::size_t size = 0; size < bytes.size(); size += size < 1000 ? 7 : 197)
    (void)read_pixel_spectrum({std::string_view(bytes).substr(0, size), "b.exr"}, "4x69");
  EXPECT_FALSE(read_pixel_spectrum({std::string_view(bytes).substr(0, 100), "b.exr"}, "0x0"));
  EXPECT_FALSE(read_pixel_spectrum({"", "b.exr"}, "0x0"));
  for (std::size_t i = 0; i < std::min<std::size_t>(bytes.size(), 2000); i += 5)
    for (const char to : {'\0', '\x7f', '\xff'}) {
      std::string damaged = bytes;
      damaged[i] = to;
      const auto read = read_pixel_spectrum({damaged, "b.exr"}, "0x0-4x69");
      EXPECT_TRUE(!read || read->spectra.size() == 1);
    }
}

}  // namespace
}  // namespace metamer
