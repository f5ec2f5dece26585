// EXR files of all kinds: which part and layer is the picture, and which pixels.
#include "common/image/read_exr_xyz.h"

#include <sys/resource.h>

#include <fstream>
#include <iterator>

#include "common/color/srgb.h"
#include "common/color/xyz.h"
#include "common/image/compare.h"
#include "exr_file.h"
#include "image_file.h"

namespace metamer {
namespace {

namespace fs = std::filesystem;
using ExrFile = ImageFile;
using Channels = std::vector<std::pair<std::string, float>>;

const Channels wanted = {{"R", 0.4F}, {"G", 0.2F}, {"B", 0.1F}};
const Channels other = {{"R", 0.5F}, {"G", 0.7F}, {"B", 0.9F}};

/// The same channels in a layer.
Channels in_layer(const std::string& layer, Channels channels) {
  for (auto& [name, value] : channels) name = layer + "." + name;
  return channels;
}

Channels both(Channels a, const Channels& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

fs::path case_file(const char* name) {
  return fs::path(METAMER_TEST_DATA) / "common/image/cases" / name;
}

std::string joined(const std::vector<std::string>& notes) {
  std::string text;
  for (const std::string& note : notes) text += note + "\n";
  return text;
}

/// That every pixel of linear sRGB is this; returns what is said of the file.
std::string said_of(const fs::path& file, const Rgb& rgb, const PictureChoice& choice = {}) {
  const auto picture = read_xyz(file, {}, choice);
  if (!picture) return "error: " + picture.error().message;
  const Xyz xyz = srgb::to_xyz(rgb);
  for (std::size_t i = 0; i < picture->image.pixels.size(); ++i)
    EXPECT_NEAR(picture->image.pixels[i], xyz[i % 3], 3e-4) << file << " at " << i;
  return picture->what + "\n" + joined(picture->notes);
}

std::string exr_refusal(const fs::path& file, const PictureChoice& choice = {}) {
  const auto picture = read_xyz(file, {}, choice);
  return picture ? "none" : picture.error().message;
}

TEST_F(ExrFile, OfHoudiniIsItsPartC) {
  EXPECT_EQ(said_of(case_file("houdini.exr"), {0.4, 0.2, 0.1}),
            "linear sRGB, part \"C\"\npart \"C\" is taken for the picture; beside it are part "
            "\"N\" (R G B), part \"albedo\" (R G B)\n");
  const auto a = read_xyz(case_file("houdini.exr"), {}), b = read_xyz(case_file("rgb.exr"), {});
  EXPECT_EQ(compare(a->image, b->image, Metric::de00, srgb::to_xyz({1, 1, 1}))->statistics.maximum,
            0);
}

TEST_F(ExrFile, OfSpectraBesideRgbSaysWhichItTook) {
  EXPECT_EQ(said_of(case_file("multipart.exr"), {0.25, 0.25, 0.25}),
            "linear sRGB, part \"rgb\"\npart \"rgb\" is taken for the picture; beside it are part "
            "\"spectral\" (spectra)\n");
  const auto spectra = read_xyz(case_file("multipart.exr"), {}, {.part = "spectral"});
  ASSERT_TRUE(spectra) << format(spectra.error());
  EXPECT_EQ(spectra->what, "an emission at 47 wavelengths, part \"spectral\"");
  EXPECT_TRUE(spectra->chosen);
}

TEST_F(ExrFile, IsThePartOrLayerWhoseNameMeansThePicture) {
  const fs::path file = folder_ / "a.exr";
  // In any place, case and spelling; with normals, depth, other colours and masks beside it.
  for (const char* name : {"C", "rgba", "RGB", "Beauty", "ViewLayer.Combined", "color"}) {
    for (const bool first : {false, true}) {
      std::vector<TestPart> parts = {
          {.name = "N", .channels = {{"X", 0.1F}, {"Y", 0.2F}, {"Z", 0.3F}}},
          {.name = "depth", .channels = {{"Z", 9}}},
          {.name = "diffuse", .channels = other}};
      parts.insert(first ? parts.begin() : parts.end(), {.name = name, .channels = wanted});
      write_parts(file, parts);
      EXPECT_EQ(said_of(file, {0.4, 0.2, 0.1}).substr(0, 17), "linear sRGB, part") << name;
    }
    write_parts(file, {{.channels = both(in_layer(name, wanted), in_layer("albedo", other))}});
    EXPECT_EQ(said_of(file, {0.4, 0.2, 0.1}).substr(0, 18), "linear sRGB, layer") << name;
  }
  // Channels without a layer are the picture beside others; words and small letters are channels.
  write_parts(file, {{.channels = both(wanted, in_layer("specular", other))}});
  EXPECT_EQ(said_of(file, {0.4, 0.2, 0.1}),
            "linear sRGB\nR G B is taken for the picture; beside it are layer \"specular\" (R G "
            "B)\n");
  write_parts(file, {{.channels = {{"red", 0.4F}, {"green", 0.2F}, {"blue", 0.1F}, {"Z", 5}}}});
  EXPECT_EQ(said_of(file, {0.4, 0.2, 0.1}), "linear sRGB\n");
  // A stereo pair's views are two pictures; a view in the name is none of it.
  write_parts(file, {{.name = "rgba.left", .channels = wanted, .view = "left"},
                     {.name = "albedo.left", .channels = other, .view = "left"}});
  EXPECT_EQ(said_of(file, {0.4, 0.2, 0.1}).substr(0, 17), "linear sRGB, part");
  // The only colour needs no name.
  write_parts(file, {{.name = "mask", .channels = {{"A", 1}}}, {.name = "x", .channels = wanted}});
  EXPECT_EQ(said_of(file, {0.4, 0.2, 0.1}), "linear sRGB, part \"x\"\n");
}

TEST_F(ExrFile, ThatCouldBeSeveralPicturesAsksWhich) {
  const fs::path file = folder_ / "a.exr";
  write_parts(file, {{.name = "diffuse", .channels = other}, {.name = "sss", .channels = wanted}});
  EXPECT_EQ(exr_refusal(file),
            "any of these could be the picture: part \"diffuse\" (R G B), part \"sss\" (R G B); "
            "say which by --part");
  EXPECT_EQ(said_of(file, {0.4, 0.2, 0.1}, {.part = "SSS"}), "linear sRGB, part \"sss\"\n");
  EXPECT_EQ(exr_refusal(file, {.part = "C"}),
            "no part \"C\" is a picture; there are part \"diffuse\" (R G B), part \"sss\" (R G B)");
  write_parts(file, {{.name = "rgba.left", .channels = wanted, .view = "left"},
                     {.name = "rgba.right", .channels = other, .view = "right"}});
  EXPECT_NE(exr_refusal(file).find("say which by --part"), std::string::npos);

  write_parts(file, {{.channels = both(in_layer("diffuse", other), in_layer("sss.L", wanted))}});
  EXPECT_EQ(exr_refusal(file),
            "any of these could be the picture: layer \"diffuse\" (R G B), layer \"sss.L\" (R G "
            "B); say which by --layer");
  EXPECT_EQ(said_of(file, {0.4, 0.2, 0.1}, {.layer = "sss.L"}), "linear sRGB, layer \"sss.L\"\n");
  EXPECT_EQ(exr_refusal(file, {.layer = ""}).substr(0, 11), "no layer \"\"");
  write_parts(file, {{.channels = both(wanted, in_layer("beauty", other))}});
  EXPECT_EQ(said_of(file, {0.4, 0.2, 0.1}, {.layer = ""}), "linear sRGB\n");

  write_parts(file, {{.channels = {{"Z", 1}, {"id", 2}}}});
  EXPECT_EQ(exr_refusal(file),
            "the picture has neither X Y Z nor R G B nor a spectrum; its channels are \"Z\", "
            "\"id\"");
  // A file of one picture is meant by any choice, and says that it was not made.
  write_parts(file, {{.channels = wanted}});
  EXPECT_FALSE(read_xyz(file, {}, {.part = "C", .layer = "diffuse"})->chosen);
}

TEST_F(ExrFile, HasASpectrumInALayerOrAPreviewBesideIt) {
  const fs::path file = folder_ / "a.exr";
  const Channels spectrum = {{"S0.500nm", 1}, {"S0.600,0nm", 1}, {"S0.700.5nm", 1}};
  write_parts(file, {{.channels = both(wanted, spectrum)}});
  EXPECT_EQ(read_xyz(file, {})->what, "an emission at 3 wavelengths");
  write_parts(file, {{.channels = both(wanted, in_layer("left.lamp", spectrum))}});
  EXPECT_EQ(read_xyz(file, {}, {.layer = "left.lamp"})->what,
            "an emission at 3 wavelengths, layer \"left.lamp\"");
  EXPECT_NE(said_of(file, {0.4, 0.2, 0.1}).find("layer \"left.lamp\" (spectra)"),
            std::string::npos);
  write_parts(file, {{.name = "refl", .channels = {{"T.500nm", 1}, {"T.600nm", 1}}},
                     {.name = "light", .channels = spectrum}});
  EXPECT_NE(exr_refusal(file).find("\"refl\" (spectra), part \"light\" (spectra)"),
            std::string::npos);
}

/// The value of a pixel whose file has 1 in its data window; -1: it can't be read.
float red_at(const XyzPicture& picture, int x, int y) { return picture.image.at(x, y)[0]; }

TEST_F(ExrFile, IsItsDisplayWindowBlackWithoutData) {
  const fs::path file = folder_ / "a.exr";
  const Channels xyz = {{"X", 1}, {"Y", 1}, {"Z", 1}};
  for (const bool tiled : {false, true}) {
    // Smaller than the picture; larger, with overscan; offset, over a corner; negative numbers.
    for (const Imath::Box2i& data :
         {Imath::Box2i{{2, 1}, {3, 2}}, Imath::Box2i{{-5, -70}, {20, 90}},
          Imath::Box2i{{-3, 2}, {1, 9}}, Imath::Box2i{{4, 4}, {4, 4}}}) {
      for (const Imath::V2i& origin : {Imath::V2i{0, 0}, Imath::V2i{-100, 7}}) {
        const Imath::Box2i moved{data.min + origin, data.max + origin};
        write_parts(file, {{.channels = xyz,
                            .display = {origin, origin + Imath::V2i{4, 4}},
                            .data = moved,
                            .tiled = tiled}});
        const auto picture = read_xyz(file, {});
        ASSERT_TRUE(picture) << format(picture.error());
        ASSERT_EQ(picture->image.width, 5);
        ASSERT_EQ(picture->image.height, 5);
        EXPECT_FALSE(picture->notes.empty());
        for (int y = 0; y < 5; ++y)
          for (int x = 0; x < 5; ++x)
            EXPECT_EQ(red_at(*picture, x, y), data.intersects(Imath::V2i{x, y}) ? 1 : 0)
                << x << ", " << y << " of " << data.min << data.max;
      }
    }
  }
  write_parts(file, {{.channels = xyz, .data = {{7, 7}, {9, 9}}}});
  EXPECT_EQ(exr_refusal(file),
            "the picture has no pixels: its data window lies outside of its display window");
  write_parts(file,
              {{.channels = xyz, .display = {{0, 0}, {99999, 99999}}, .data = {{0, 0}, {1, 1}}}});
  EXPECT_EQ(exr_refusal(file).substr(0, 24), "the picture is too large");
}

TEST_F(ExrFile, AnAttributeThatClaimsMoreThanTheFileHasIsRefused) {
  const fs::path file = folder_ / "a.exr";
  write_parts(file, {{.name = "C", .channels = wanted}, {.name = "N", .channels = other}});
  std::ifstream in(file, std::ios::binary);
  std::string bytes(std::istreambuf_iterator<char>(in), {});
  const std::string attribute("name\0string\0", 12);
  const std::size_t at = bytes.find(attribute);
  ASSERT_NE(at, std::string::npos);
  bytes.replace(at + attribute.size(), 4, "\xF0\xFF\xFF\x7F");
  std::ofstream(file, std::ios::binary) << bytes;
  rusage before{}, after{};
  getrusage(RUSAGE_SELF, &before);
  EXPECT_EQ(exr_refusal(file).substr(0, 22), "can't read the picture");
  getrusage(RUSAGE_SELF, &after);
  EXPECT_LT(after.ru_maxrss, before.ru_maxrss + 100'000) << "KiB";
}

TEST_F(ExrFile, OfAnySampleTypeIsRead) {
  const fs::path file = folder_ / "a.exr";
  for (const bool tiled : {false, true}) {
    write_parts(file, {{.channels = wanted, .type = Imf::HALF, .tiled = tiled}});
    EXPECT_EQ(said_of(file, {0.4, 0.2, 0.1}), "linear sRGB\n");
    write_parts(file, {{.name = "C",
                        .channels = {{"R", 3}, {"G", 2}, {"B", 1}},
                        .type = Imf::UINT,
                        .tiled = tiled},
                       {.name = "N", .channels = other, .type = Imf::HALF}});
    EXPECT_NE(said_of(file, {3, 2, 1}).find("whole numbers (uint)"), std::string::npos);
  }
}

TEST_F(ExrFile, NamesItsAlphaAndItsSingleY) {
  const fs::path file = folder_ / "a.exr";
  write_parts(file, {{.channels = both(wanted, {{"A", 0.5F}})}});
  EXPECT_EQ(said_of(file, {0.4, 0.2, 0.1}),
            "linear sRGB\nits alpha goes from 0.5 to 0.5: it is compared as over black\n");
  write_parts(file, {{.channels = both(wanted, {{"A", 1}})}});
  EXPECT_EQ(said_of(file, {0.4, 0.2, 0.1}), "linear sRGB\nits alpha is 1 everywhere\n");
  write_parts(file, {{.channels = {{"Y", 0.25F}, {"A", 1}}}});
  EXPECT_EQ(said_of(file, {0.25, 0.25, 0.25}),
            "Y\nits alpha is 1 everywhere\nits single channel, Y, is taken for the luminance of a "
            "grey\n");
  write_parts(file, {{.channels = {{"Y", 0.25F}}}});
  EXPECT_EQ(said_of(file, {0.25, 0.25, 0.25}),
            "Y\nits single channel, Y, is taken for the luminance of a grey\n");
}

TEST_F(ExrFile, GoesByTheChromaticitiesOfItsPart) {
  // Rec. 2020's red, in the second part alone; x 0.708, y 0.292 (ITU-R BT.2020), luminance 0.2627.
  const std::vector<float> rec_2020 = {0.708F, 0.292F, 0.170F,  0.797F,
                                       0.131F, 0.046F, 0.3127F, 0.3290F};
  const Channels red = {{"R", 1}, {"G", 0}, {"B", 0}};
  const fs::path file = folder_ / "a.exr";
  write_parts(file, {{.name = "C", .channels = red, .chromaticities = rec_2020},
                     {.name = "N", .channels = other, .chromaticities = rec_2020}});
  const auto picture = read_xyz(file, {});
  ASSERT_TRUE(picture) << format(picture.error());
  EXPECT_EQ(picture->what, "linear RGB of the file's own primaries, part \"C\"");
  const float* pixel = picture->image.at(0, 0);
  EXPECT_NEAR(pixel[0] / (pixel[0] + pixel[1] + pixel[2]), 0.708, 1e-4);
  EXPECT_NEAR(pixel[1], 0.2627, 1e-4);
}

/// A part of deep pixels without a sample, and a flat one behind it.
void write_deep(const fs::path& file, const TestPart* flat) {
  Imf::Header header = test_header({.name = "C", .channels = wanted});
  header.setType(Imf::DEEPSCANLINE);
  header.compression() = Imf::ZIPS_COMPRESSION;
  std::vector<Imf::Header> headers = {header};
  if (flat != nullptr) headers.push_back(test_header(*flat));
  Imf::MultiPartOutputFile output(file.c_str(), headers.data(), static_cast<int>(headers.size()));
  Imf::DeepScanLineOutputPart deep(output, 0);
  const std::vector<unsigned> counts(4, 0);
  const std::vector<const float*> samples(4, nullptr);
  const auto bytes = [](const auto& from) {
    return const_cast<char*>(reinterpret_cast<const char*>(from.data()));
  };
  Imf::DeepFrameBuffer buffer;
  buffer.insertSampleCountSlice(Imf::Slice(Imf::UINT, bytes(counts), 4, 8));
  for (const auto& [name, value] : wanted)
    buffer.insert(name, Imf::DeepSlice(Imf::FLOAT, bytes(samples), 8, 16, 4));
  deep.setFrameBuffer(buffer);
  deep.writePixels(2);
  if (flat == nullptr) return;
  TestPlanes planes;
  Imf::OutputPart pixels(output, 1);
  pixels.setFrameBuffer(test_buffer(*flat, planes));
  pixels.writePixels(2);
}

TEST_F(ExrFile, ThatIsDeepOrSubsampledIsRefusedByName) {
  const fs::path file = folder_ / "a.exr";
  write_deep(file, nullptr);
  EXPECT_EQ(exr_refusal(file), "can't read the picture: it is deep (deepscanline)");
  const TestPart flat = {.name = "N", .channels = other};
  write_deep(file, &flat);
  EXPECT_EQ(exr_refusal(file), "can't read the picture: it is deep (deepscanline)");
  EXPECT_EQ(said_of(file, {0.5, 0.7, 0.9}, {.part = "N"}), "linear sRGB, part \"N\"\n");
  write_parts(file, {{.channels = {{"BY", 0}, {"RY", 0}, {"Y", 1}}}});
  EXPECT_EQ(exr_refusal(file),
            "the picture is luminance and chroma (Y, RY, BY), which is not read");
  write_parts(file, {{.channels = {{"B", 1}, {"G", 1}, {"R", 1}}, .sampling = 2}});
  EXPECT_EQ(exr_refusal(file),
            "can't read the picture: channel \"R\" has fewer samples than there are pixels");
  // A channel that is not wanted may have fewer.
  write_parts(file, {{.channels = both(wanted, {{"depth.Z", 1}}), .sampling = 2}});
  EXPECT_EQ(said_of(file, {0.4, 0.2, 0.1}), "linear sRGB\n");
}

}  // namespace
}  // namespace metamer
