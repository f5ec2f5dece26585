// `metamer compare`: two picture files, no server.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "common/color/srgb.h"
#include "common/image/spectral_exr.h"
#include "daemon.h"
#include "process.h"
#include "scenes.h"

namespace metamer::test {
namespace {

/// A grey picture, 4 × 3, of luminance 1 but for a pixel.
void write_grey(const std::string& file, float other) {
  Image image = make_image(4, 3, {"X", "Y", "Z"});
  const Xyz white = srgb::to_xyz({1, 1, 1});
  for (std::size_t i = 0; i < image.pixels.size(); ++i)
    image.pixels[i] = static_cast<float>(white[i % 3]);
  for (std::size_t c = 0; c < 3; ++c) image.at(2, 1)[c] *= other;
  ASSERT_TRUE(write_image(image, file, file.ends_with(".exr"), {}));
}

class CompareCommand : public testing::Test {
 protected:
  CompareCommand() {
    write_grey(a, 1);
    write_grey(b, 0.125F);
  }
  Folder folder;
  const std::string a = folder / "a.exr", b = folder / "b.exr";
};

TEST_F(CompareCommand, SaysHowMuchAndWhere) {
  const Ended ended = metamer({"compare", a, b, "--metric", "deab"});
  EXPECT_EQ(ended.code, 0) << ended.err;
  // L* of an eighth is 42, of the white 100; 58 in one of 12 pixels.
  EXPECT_EQ(ended.out, a + ": X Y Z\n" + b + ": X Y Z\n" +
                           "ΔE*ab, white D65 (sRGB): X 0.9505 Y 1.0000 Z 1.0891\n"
                           "mean 4.833, median 0, 95th percentile 26.1, 99th percentile 51.62\n"
                           "maximum 58 at (2, 1)\n");
}

TEST_F(CompareCommand, ExitsWith1OverTheLimitAlone) {
  EXPECT_EQ(metamer({"compare", a, b, "--metric", "deab", "--max", "58.01"}).code, 0);
  const Ended over = metamer({"compare", a, b, "--metric", "deab", "--max", "57.9"});
  EXPECT_EQ(over.code, 1);
  EXPECT_EQ(over.err, "error: the maximum, 58, is above the limit, 57.9\n");
  EXPECT_EQ(metamer({"compare", a, a, "--max", "0"}).code, 0);
}

TEST_F(CompareCommand, ComparesAPngWithAnExr) {
  const std::string png = folder / "a.png";
  write_grey(png, 1);
  const Json answer = parse_document(metamer({"compare", a, png, "--json"}).out);
  EXPECT_EQ(answer["exit_code"], 0);
  EXPECT_EQ(answer["b"]["what"], "sRGB");
  EXPECT_LT(answer["difference"]["maximum"].get<double>(), 1e-3);
}

TEST_F(CompareCommand, DrawsTheDifference) {
  const std::string picture = folder / "diff.png";
  const Json answer = parse_document(metamer({"compare", a, b, "-o", picture, "--json"}).out);
  EXPECT_EQ(answer["exit_code"], 0) << answer;
  EXPECT_EQ(answer["files"], Json::array({picture}));
  const auto drawn = read_image(picture);
  ASSERT_TRUE(drawn);
  EXPECT_GT(drawn->height, 3) << "a legend";
  EXPECT_EQ(metamer({"compare", a, b, "-o", folder / "diff.exr"}).code, 2);
}

TEST_F(CompareCommand, PlacesWhatIsNotFiniteAndNeverPassesIt) {
  write_grey(b, std::nanf(""));
  const Ended ended = metamer({"compare", a, b});
  EXPECT_EQ(ended.code, 0);
  EXPECT_EQ(ended.err, b + ": note: 1 pixel has no finite colour in one of the pictures, the first "
                           "at (2, 1) of this one\n");
  const Json answer = parse_document(metamer({"compare", a, b, "--max", "9", "--json"}).out);
  EXPECT_EQ(answer["exit_code"], 1);
  EXPECT_EQ(answer["difference"]["not_finite"], 1);
  EXPECT_EQ(answer["difference"]["pixels"], 11);
  EXPECT_EQ(answer["difference"]["first_not_finite"]["x"], 2);
}

TEST_F(CompareCommand, TakesAWhiteByNameOrByNumbers) {
  // CIE 15:2004, table T.3: A is X 109.850, Z 35.585.
  const Json named = parse_document(metamer({"compare", a, b, "--white", "A", "--json"}).out);
  EXPECT_NEAR(named["white"]["xyz"][0].get<double>(), 1.0985, 1e-4);
  EXPECT_NEAR(named["white"]["xyz"][2].get<double>(), 0.35585, 1e-4);
  const Json given = parse_document(metamer({"compare", a, b, "--white", "2,3,4.5", "--json"}).out);
  EXPECT_EQ(given["white"]["xyz"], Json::array({2.0, 3.0, 4.5}));
}

TEST_F(CompareCommand, RefusesWhatMakesNoSense) {
  const auto refused = [](const std::vector<std::string>& words) {
    const Ended ended = metamer(words);
    EXPECT_EQ(ended.code, 2) << ended.out;
    return ended.err;
  };
  EXPECT_EQ(refused({"compare", a, b, "--white", "D66"}),
            "error: --white: there is no file, CIE illuminant or test colour \"D66\"; did you mean "
            "\"D65\"?\n");
  EXPECT_EQ(refused({"compare", a, b, "--white", "1,2"}),
            "error: --white: \"1,2\" is not X,Y,Z, such as 0.95,1,1.09\n");
  EXPECT_EQ(refused({"compare", a, b, "--white", "1,0,1"}),
            "error: --white: X, Y and Z must be finite and above 0\n");
  EXPECT_EQ(refused({"compare", a, b, "--under", "A"}),
            "error: --under: neither picture is a reflectance\n");
  EXPECT_EQ(refused({"compare", a, folder / "c.exr"}),
            (folder / "c.exr") + ": error: no such file\n");
  refused({"compare", a, b, "--metric", "de94"});
  refused({"compare", a, b, "--max", "-1"});
  refused({"compare", a});
  ASSERT_TRUE(write_image(make_image(3, 4, {"X", "Y", "Z"}), folder / "tall.exr", true, {}));
  EXPECT_EQ(refused({"compare", a, folder / "tall.exr"}),
            "error: the pictures differ in size: 4 × 3 and 3 × 4 pixels\n");
}

TEST_F(CompareCommand, FindsThePictureAmongPartsOrTakesTheOneThatIsNamed) {
  const std::string cases = METAMER_TEST_DATA "/common/image/cases/";
  const std::string parts = cases + "houdini.exr", rgb = cases + "rgb.exr";
  const Ended found = metamer({"compare", parts, rgb, "--max", "0"});
  EXPECT_EQ(found.code, 0) << found.out;
  EXPECT_EQ(found.err, parts +
                           ": note: part \"C\" is taken for the picture; beside it are part "
                           "\"N\" (R G B), part \"albedo\" (R G B)\n");
  EXPECT_EQ(metamer({"compare", "--part", "c", parts, rgb, "--max", "0"}).code, 0);
  EXPECT_EQ(metamer({"compare", parts, parts, "--part", "C", "--part", "N", "--max", "1"}).code, 1);
  const Json answer = parse_document(metamer({"compare", parts, rgb, "--json"}).out);
  EXPECT_EQ(answer["a"]["what"], "linear sRGB, part \"C\"");
  EXPECT_EQ(answer["notes"][0]["file"], parts);
  const Ended none = metamer({"compare", rgb, rgb, "--layer", "diffuse"});
  EXPECT_EQ(none.code, 2);
  EXPECT_EQ(none.err, "error: --part, --layer: neither picture has any\n");
  EXPECT_EQ(metamer({"compare", parts, rgb, "--part", "P"}).code, 2);
  EXPECT_EQ(metamer({"compare", parts, parts, "--part", "C", "--part", "C", "--part", "C"}).code,
            2);
}

TEST_F(CompareCommand, SaysWhatItTookAPngFor) {
  const std::string cases = METAMER_TEST_DATA "/common/image/cases/";
  const Ended ended = metamer({"compare", cases + "gama1.png", cases + "cicp_p3.png"});
  EXPECT_EQ(ended.err, cases + "gama1.png: note: it names no primaries: sRGB's are taken\n");
  EXPECT_NE(ended.out.find("gama1.png: gamma 1 (gAMA)\n"), std::string::npos) << ended.out;
  EXPECT_NE(ended.out.find("cicp_p3.png: Display P3's primaries, sRGB's curve (cICP 12, 13)\n"),
            std::string::npos);
}

TEST_F(CompareCommand, TellsMetamersApartUnderASecondLight) {
  // Two reflectances that match under E: one flat, the other with what E's observer cannot see
  // added (its three sums are made zero by Gram and Schmidt).
  SpectralImage flat;
  flat.width = flat.height = 1;
  flat.reflectance = true;
  for (int nm = 400; nm <= 700; nm += 5) flat.nm.push_back(nm);
  flat.values.assign(flat.nm.size(), 0.5F);
  const ObserverWeights weights = under_light(cie::observer_1931(), *cie::illuminant("E"), flat.nm);
  std::vector<std::vector<double>> seen;
  const auto remove_seen = [&](std::vector<double> v) {
    for (const auto& unit : seen) {
      double along = 0;
      for (std::size_t i = 0; i < v.size(); ++i) along += v[i] * unit[i];
      for (std::size_t i = 0; i < v.size(); ++i) v[i] -= along * unit[i];
    }
    return v;
  };
  for (const auto& row : weights.weights) {
    std::vector<double> rest = remove_seen(row);
    double size = 0;
    for (const double value : rest) size += value * value;
    for (double& value : rest) value /= std::sqrt(size);
    seen.push_back(rest);
  }
  std::vector<double> black(flat.nm.size());
  for (std::size_t i = 0; i < black.size(); ++i) black[i] = std::sin(static_cast<double>(i) / 3);
  black = remove_seen(black);
  SpectralImage wavy = flat;
  for (std::size_t i = 0; i < black.size(); ++i)
    wavy.values[i] += 0.3F * static_cast<float>(black[i]);
  const Image preview = make_image(1, 1, {"X", "Y", "Z"});
  ASSERT_TRUE(write_spectral_exr(flat, preview, folder / "flat.exr", {}));
  ASSERT_TRUE(write_spectral_exr(wavy, preview, folder / "wavy.exr", {}));

  const std::string flat_file = folder / "flat.exr", wavy_file = folder / "wavy.exr";
  EXPECT_EQ(metamer({"compare", flat_file, wavy_file}).code, 2) << "no light";
  EXPECT_EQ(metamer({"compare", flat_file, wavy_file, "--under", "E", "--max", "0.001"}).code, 0);
  EXPECT_EQ(metamer({"compare", flat_file, wavy_file, "--under", "F11", "--max", "1"}).code, 1);
  // They matched for the 2° observer, not for the other.
  EXPECT_EQ(metamer({"compare", flat_file, wavy_file, "--under", "E", "--observer",
                     "cie-1964-10deg", "--max", "0.1"})
                .code,
            1);
}

TEST_F(CompareCommand, SaysWhereTheModuleOfFileFormatsIsMissing) {
  const std::string alone = folder / "metamer";
  std::filesystem::copy_file(METAMER_BIN "/metamer", alone);
  const Ended ended = run({alone, "compare", a, b, "-o", folder / "c.png"});
  EXPECT_EQ(ended.code, 1);
  EXPECT_EQ(ended.err.rfind("error: can't load what draws legends and reads JPEGs: " +
                                folder.path() + "/metamer-file-formats.so: ",
                            0),
            0u)
      << ended.err;
  write_grey(folder / "a.png", 1);
  EXPECT_EQ(run({alone, "compare", a, folder / "a.png"}).code, 0) << "reading needs no module";
}

}  // namespace
}  // namespace metamer::test
