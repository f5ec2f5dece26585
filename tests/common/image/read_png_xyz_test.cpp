// PNG files of all kinds: their samples, and what their numbers mean.
#include "common/image/read_png_xyz.h"

#include <lcms2.h>
#include <zlib.h>

#include <cmath>
#include <fstream>

#include "common/color/adaptation.h"
#include "common/color/srgb.h"
#include "common/image/compare.h"
#include "image_file.h"
#include "png_file.h"

namespace metamer {
namespace {

namespace fs = std::filesystem;
using PngFile = ImageFile;
using Chunks = std::vector<std::pair<std::string, std::string>>;

const std::string gamma_1 = big_endian(100000);
/// sRGB's, and Rec. 2020's (ITU-R BT.2020): white, red, green, blue.
std::string chrm(const std::vector<double>& xy) {
  std::string data;
  for (const double value : xy)
    data += big_endian(static_cast<std::uint32_t>(std::lround(value * 100000)));
  return data;
}

std::string icc_chunk(const std::string& profile) {
  uLongf size = compressBound(profile.size());
  std::string packed(size, '\0');
  compress(reinterpret_cast<Bytef*>(packed.data()), &size,
           reinterpret_cast<const Bytef*>(profile.data()), profile.size());
  return std::string("name\0\0", 6) + packed.substr(0, size);
}

std::string file_text(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// One pixel of 8 bits.
Result<XyzPicture> read_pixel(const fs::path& file, const std::vector<unsigned char>& codes,
                              const Chunks& chunks) {
  write_test_png(file, {.color_type = codes.size() == 1 ? PNG_COLOR_TYPE_GRAY : PNG_COLOR_TYPE_RGB,
                        .bytes = codes,
                        .chunks = chunks});
  return read_xyz(file, {});
}

void expect_pixel(const Result<XyzPicture>& picture, const Xyz& expected, double within) {
  ASSERT_TRUE(picture) << format(picture.error());
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(picture->image.pixels[c], expected[c], within) << picture->what << ' ' << c;
}

std::string refused_because(const Result<XyzPicture>& picture) {
  return picture ? "read as " + picture->what : picture.error().message;
}

double max_difference(const char* a, const char* b) {
  const fs::path cases = fs::path(METAMER_TEST_DATA) / "common/image/cases";
  const auto one = read_xyz(cases / a, {}), other = read_xyz(cases / b, {});
  return compare(one->image, other->image, Metric::de00, srgb::to_xyz({1, 1, 1}))
      ->statistics.maximum;
}

TEST_F(PngFile, IsWhatItsGammaAndItsCicpSay) {
  EXPECT_NEAR(max_difference("plain.png", "gama1.png"), 19.6, 0.05);
  EXPECT_NEAR(max_difference("plain.png", "cicp_p3.png"), 3.64, 0.005);
}

TEST_F(PngFile, OfAnyGammaIsThatPowerOfItsNumbers) {
  for (const double gamma : {1.0, 1 / 1.8, 1 / 2.2, 0.1}) {
    const auto data = big_endian(static_cast<std::uint32_t>(std::lround(gamma * 100000)));
    const double stored = std::round(gamma * 100000) / 100000;
    Rgb rgb{};
    for (std::size_t c = 0; c < 3; ++c)
      rgb[c] = std::pow((50.0 + 60.0 * static_cast<double>(c)) / 255, 1 / stored);
    const auto picture = read_pixel(folder_ / "a.png", {50, 110, 170}, {{"gAMA", data}});
    expect_pixel(picture, srgb::to_xyz(rgb), 1e-6);
    EXPECT_EQ(picture->notes.size(), 1u) << "its primaries are guessed";
  }
}

TEST_F(PngFile, OfPrimariesOfItsOwnHasThese) {
  const std::vector<double> wide = {0.3127, 0.3290, 0.708, 0.292, 0.170, 0.797, 0.131, 0.046};
  const auto red =
      read_pixel(folder_ / "a.png", {255, 0, 0}, {{"gAMA", gamma_1}, {"cHRM", chrm(wide)}});
  const double y = 0.2627;  // ITU-R BT.2020, table 4
  expect_pixel(red, {0.708 / 0.292 * y, y, 0}, 1e-4);
  EXPECT_EQ(red->what, "primaries of its own (cHRM), gamma 1 (gAMA)");
  EXPECT_TRUE(red->notes.empty());
  // Without a gamma the curve is sRGB's, and that is said; a white that is not D65 is seen as one.
  const std::vector<double> d50 = {0.3457, 0.3585, 0.64, 0.33, 0.30, 0.60, 0.15, 0.06};
  const auto grey = read_pixel(folder_ / "a.png", {188, 188, 188}, {{"cHRM", chrm(d50)}});
  const double level = srgb::decode(188 / 255.0);
  expect_pixel(grey, srgb::to_xyz({level, level, level}), 1e-5);
  EXPECT_EQ(grey->notes.size(), 1u);
}

TEST_F(PngFile, OfACicpIsAsTablesOfH273HaveIt) {
  const auto read = [&](unsigned char primaries, unsigned char transfer,
                        const std::vector<unsigned char>& codes) {
    return read_pixel(
        folder_ / "a.png", codes,
        {{"cICP", {static_cast<char>(primaries), static_cast<char>(transfer), 0, 1}}});
  };
  // Chromaticities of red of ITU-T H.273, table 2.
  const std::pair<int, Chromaticity> reds[] = {{1, {0.640, 0.330}},  {5, {0.64, 0.33}},
                                               {6, {0.630, 0.340}},  {9, {0.708, 0.292}},
                                               {12, {0.680, 0.320}}, {22, {0.630, 0.340}}};
  for (const auto& [code, red] : reds) {
    const auto picture = read(static_cast<unsigned char>(code), 8, {255, 0, 0});
    ASSERT_TRUE(picture) << code;
    const float* p = picture->image.at(0, 0);
    EXPECT_NEAR(p[0] / (p[0] + p[1] + p[2]), red.x, 1e-5) << code;
    EXPECT_NEAR(p[1] / (p[0] + p[1] + p[2]), red.y, 1e-5) << code;
    expect_pixel(read(static_cast<unsigned char>(code), 13, {255, 255, 255}),
                 srgb::to_xyz({1, 1, 1}), 1e-5);
  }
  // Whites other than D65 are seen as D65.
  for (const int code : {4, 11})
    expect_pixel(read(static_cast<unsigned char>(code), 8, {255, 255, 255}),
                 srgb::to_xyz({1, 1, 1}), 1e-5);
  // A grey by each curve.
  const double v = 100 / 255.0;
  const std::pair<int, double> levels[] = {{1, std::pow(v, 2.4)},
                                           {4, std::pow(v, 2.2)},
                                           {5, std::pow(v, 2.8)},
                                           {6, std::pow(v, 2.4)},
                                           {8, v},
                                           {13, std::pow((v + 0.055) / 1.055, 2.4)},
                                           {14, std::pow(v, 2.4)},
                                           {15, std::pow(v, 2.4)}};
  for (const auto& [code, level] : levels) {
    const auto picture = read(1, static_cast<unsigned char>(code), {100});
    expect_pixel(picture, srgb::to_xyz({level, level, level}), 1e-6);
    EXPECT_EQ(picture->notes.size(), code == 4 || code == 5 || code == 8 || code == 13 ? 0u : 1u);
  }
}

TEST_F(PngFile, OfVideoRangeHasBlackAt16AndWhiteAt235) {
  const Chunks video = {{"cICP", {1, 8, 0, 0}}};
  expect_pixel(read_pixel(folder_ / "a.png", {16}, video), {0, 0, 0}, 1e-7);
  expect_pixel(read_pixel(folder_ / "a.png", {235}, video), srgb::to_xyz({1, 1, 1}), 1e-6);
  const double level = (100 - 16) / 219.0;
  expect_pixel(read_pixel(folder_ / "a.png", {100}, video), srgb::to_xyz({level, level, level}),
               1e-6);
  // 16 bits: 16 · 256 and 235 · 256.
  for (const unsigned code : {16U * 256, 235U * 256}) {
    write_test_png(folder_ / "a.png", {.color_type = PNG_COLOR_TYPE_GRAY,
                                       .bits = 16,
                                       .bytes = {static_cast<unsigned char>(code / 256), 0},
                                       .chunks = video});
    const double white = code == 16 * 256 ? 0 : 1;
    expect_pixel(read_xyz(folder_ / "a.png", {}), srgb::to_xyz({white, white, white}), 1e-6);
  }
}

TEST_F(PngFile, OfACicpThatNoScreenTellsIsRefusedByName) {
  const auto refused = [&](const std::string& cicp) {
    return refused_because(read_pixel(folder_ / "a.png", {1, 2, 3}, {{"cICP", cicp}}));
  };
  EXPECT_EQ(refused({9, 16, 0, 1}),
            "the picture's cICP names the transfer 16 (PQ of BT.2100, cd/m² without a "
            "white), which is not read");
  EXPECT_EQ(refused({9, 18, 0, 1}),
            "the picture's cICP names the transfer 18 (HLG of BT.2100, which each screen "
            "shows otherwise), which is not read");
  EXPECT_EQ(refused({1, 2, 0, 1}),
            "the picture's cICP names the transfer 2 (unspecified), which is not read");
  EXPECT_EQ(refused({2, 13, 0, 1}),
            "the picture's cICP names the primaries 2 (unspecified), which are not read");
  EXPECT_EQ(refused({99, 13, 0, 1}),
            "the picture's cICP names the primaries 99, which are not read");
  EXPECT_EQ(refused({1, 13, 1, 1}),
            "the picture's cICP names the matrix 1, where a PNG has none (0)");
  EXPECT_EQ(refused({1, 13, 0, 7}), "the picture's cICP names a range other than 0 and 1: 7");
  EXPECT_EQ(refused({1, 13, 0}), "what its cICP says can't be used: it has 3 bytes, not 4");
}

/// A profile in memory, of LittleCMS's making.
std::string saved(cmsHPROFILE profile) {
  cmsUInt32Number size = 0;
  cmsSaveProfileToMem(profile, nullptr, &size);
  std::string bytes(size, '\0');
  cmsSaveProfileToMem(profile, bytes.data(), &size);
  cmsCloseProfile(profile);
  return bytes;
}

TEST_F(PngFile, OfAnIccProfileIsWhatTransiccMakesOfIt) {
  const fs::path profiles = "/usr/share/color/icc/colord";
  const std::vector<unsigned char> codes = {200, 120, 40};
  for (const char* name : {"AdobeRGB1998", "ProPhotoRGB", "SwappedRedAndGreen", "NTSC-RGB", "sRGB",
                           "Rec709", "CIE-RGB"}) {
    const fs::path profile = profiles / (std::string(name) + ".icc");
    const auto picture =
        read_pixel(folder_ / "a.png", codes, {{"iCCP", icc_chunk(file_text(profile))}});
    ASSERT_TRUE(picture) << format(picture.error());
    EXPECT_EQ(picture->what.substr(0, 17), "the ICC profile \"") << name;
    // X Y Z of D50, in percent, by LittleCMS's program.
    std::ofstream(folder_ / "codes") << "200 120 40\n";
    const std::string command = "cd '" + folder_.string() + "' && transicc -n -t1 -i '" +
                                profile.string() + "' -o '*XYZ' < codes > shown 2> said";
    ASSERT_EQ(std::system(command.c_str()), 0) << "liblcms2-utils";
    Xyz shown{};
    std::ifstream(folder_ / "shown") >> shown[0] >> shown[1] >> shown[2];
    for (double& value : shown) value /= 100;
    const Matrix3 to_d65 =
        *adaptation_matrix(Adaptation::bradford, {0.9642, 1, 0.8249}, srgb::to_xyz({1, 1, 1}));
    expect_pixel(picture, multiply(to_d65, shown), 1e-4);
  }
}

TEST_F(PngFile, OfAGreyProfileAndOfATableIsRead) {
  cmsToneCurve* curve = cmsBuildGamma(nullptr, 1.8);
  const std::string grey = saved(cmsCreateGrayProfile(cmsD50_xyY(), curve));
  cmsFreeToneCurve(curve);
  const double level = std::pow(77 / 255.0, 1.8);
  expect_pixel(read_pixel(folder_ / "a.png", {77}, {{"iCCP", icc_chunk(grey)}}),
               srgb::to_xyz({level, level, level}), 2e-4);

  // A table (AToB0) to Lab: its corners are greys of L* = 100 (R + G + B) / 3.
  cmsHPROFILE profile = cmsCreateProfilePlaceholder(nullptr);
  cmsSetProfileVersion(profile, 2.4);
  cmsSetDeviceClass(profile, cmsSigDisplayClass);
  cmsSetColorSpace(profile, cmsSigRgbData);
  cmsSetPCS(profile, cmsSigLabData);
  cmsPipeline* pipeline = cmsPipelineAlloc(nullptr, 3, 3);
  cmsStage* table = cmsStageAllocCLut16bit(nullptr, 2, 3, 3, nullptr);
  cmsStageSampleCLut16bit(
      table,
      [](const cmsUInt16Number in[], cmsUInt16Number out[], void*) {
        out[0] = static_cast<cmsUInt16Number>((in[0] + in[1] + in[2]) / 3 * 0xFF00LL / 0xFFFF);
        out[1] = out[2] = 0x8000;
        return 1;
      },
      nullptr, 0);
  cmsPipelineInsertStage(pipeline, cmsAT_BEGIN, table);
  cmsWriteTag(profile, cmsSigAToB0Tag, pipeline);
  cmsPipelineFree(pipeline);
  const auto picture =
      read_pixel(folder_ / "a.png", {153, 51, 102}, {{"iCCP", icc_chunk(saved(profile))}});
  // L* = 40 is Y = (56 / 116)³ by CIE 15.
  const double y = std::pow(56 / 116.0, 3);
  expect_pixel(picture, srgb::to_xyz({y, y, y}), 2e-4);
}

TEST_F(PngFile, GoesByTheFirstOfCicpProfileSrgbAndGamma) {
  const std::string adobe = icc_chunk(file_text("/usr/share/color/icc/colord/AdobeRGB1998.icc"));
  const std::string p3 = {12, 13, 0, 1};
  const std::pair<const char*, Chunks> files[] = {
      {"Display P3's primaries, sRGB's curve (cICP 12, 13)",
       {{"gAMA", gamma_1}, {"iCCP", adobe}, {"cICP", p3}}},
      {"Display P3's primaries, sRGB's curve (cICP 12, 13)",
       {{"cICP", p3}, {"sRGB", std::string(1, 0)}}},
      {"Display P3's primaries, sRGB's curve (cICP 12, 13)", {{"iCCP", "broken"}, {"cICP", p3}}},
      {"the ICC profile \"Compatible with Adobe RGB (1998)\"",
       {{"gAMA", big_endian(45455)}, {"iCCP", adobe}}},
      {"sRGB", {{"sRGB", std::string(1, 0)}, {"gAMA", gamma_1}}},
      {"sRGB", {{"gAMA", big_endian(45455)}, {"sRGB", std::string(1, 1)}}},
      {"gamma 1 (gAMA)", {{"gAMA", gamma_1}}},
      {"sRGB, as it names no space", {}}};
  for (const auto& [what, chunks] : files)
    EXPECT_EQ(refused_because(read_pixel(folder_ / "a.png", {1, 2, 3}, chunks)),
              std::string("read as ") + what);
}

TEST_F(PngFile, ThatSaysWhatCantBeIsRefused) {
  // A profile of grey in a picture of colours, one cut short, one of noise.
  cmsToneCurve* curve = cmsBuildGamma(nullptr, 1.8);
  const std::string grey = saved(cmsCreateGrayProfile(cmsD50_xyY(), curve));
  cmsFreeToneCurve(curve);
  const std::pair<const char*, std::string> chunks[] = {
      {"iCCP", "broken"},
      {"iCCP", icc_chunk(std::string(500, 'x'))},
      {"iCCP", icc_chunk(grey)},
      {"iCCP", icc_chunk(grey.substr(0, grey.size() / 2))},
      {"gAMA", big_endian(0)},
      {"gAMA", "abc"},
      {"cHRM", std::string(32, '\0')},
      {"cHRM", chrm({0.3, 0.3, 0.1, 0.1, 0.2, 0.2, 0.4, 0.4})}};
  for (const auto& [name, data] : chunks) {
    const std::string why =
        refused_because(read_pixel(folder_ / "a.png", {1, 2, 3}, {{name, data}}));
    EXPECT_EQ(why.find("what its " + std::string(name) + " says"), 0u) << why;
  }
  // A chunk whose checksum is wrong is not passed over.
  for (const auto& [name, data] :
       {std::pair("gAMA", gamma_1), std::pair("cICP", std::string{12, 13, 0, 1})}) {
    ASSERT_TRUE(read_pixel(folder_ / "a.png", {1, 2, 3}, {{name, data}}));
    std::string bytes = file_text(folder_ / "a.png");
    bytes[bytes.find(name) + 5] ^= 1;
    std::ofstream(folder_ / "a.png", std::ios::binary) << bytes;
    EXPECT_EQ(refused_because(read_xyz(folder_ / "a.png", {})),
              "what its " + std::string(name) + " says can't be used: CRC error");
  }
}

TEST_F(PngFile, ThatIsTransparentIsSeenOverBlack) {
  const fs::path file = folder_ / "a.png";
  write_test_png(file, {.color_type = PNG_COLOR_TYPE_RGB_ALPHA, .bytes = {188, 188, 188, 51}});
  const auto picture = read_xyz(file, {});
  const double level = srgb::decode(188 / 255.0) * 0.2;
  expect_pixel(picture, srgb::to_xyz({level, level, level}), 1e-6);
  EXPECT_EQ(picture->notes, std::vector<std::string>{
                                "its alpha goes from 0.2 to 0.2: it is compared as over black"});
  write_test_png(
      file, {.color_type = PNG_COLOR_TYPE_GRAY_ALPHA, .bits = 16, .bytes = {0x80, 0, 0xFF, 0xFF}});
  EXPECT_EQ(read_xyz(file, {})->notes, std::vector<std::string>{"its alpha is 1 everywhere"});
}

}  // namespace
}  // namespace metamer
