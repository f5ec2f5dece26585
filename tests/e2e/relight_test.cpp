// A relit picture is a rendered one: over mirrors and Fresnel terms, with other light, paint,
// observer.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "common/image/image.h"
#include "common/image/read_xyz.h"
#include "daemon.h"

namespace metamer::test {
namespace {

/// A paint that fluoresces and a metal ball on a varnished floor that mirrors them; `paint` and the
/// lights' spectra are put in.
std::string scene_text(const std::string& paint, const std::string& light) {
  return R"(
    camera { eye { y: 1.5 z: 4 } target { y: 0.4 } }
    settings { width: 48 height: 40 spp: 4 depth: 3 method { exact {} } }
    light { name: "key" position { x: -2 y: 4 z: 3 } luminance: 0.7 spectrum { )" +
         light + R"( } }
    light { name: "fill" direction { x: -1 y: -1 z: -1 } luminance: 0.2 spectrum { standard: "A" } }
    material {
      name: "paint" specularness: 0.3 phong { shininess: 40 }
      diffuse { )" +
         paint + R"( }
      fluorescence {
        excitation { samples { wavelength: [300, 370, 420] value: [0.05, 0.2, 0.02] } }
        emission { samples { wavelength: [410, 440, 470, 560] value: [0, 1, 0.8, 0] } }
        quantum_yield: 0.8
      }
    }
    material {
      name: "gold" diffuseness: 0 specularness: 0.5 mirror: 0.6 cook_torrance {}
      fresnel { conductor { metal: "Au" } }
    }
    material {
      name: "floor" mirror: 0.5 diffuse { samples { wavelength: [400, 700] value: [0.2, 0.6] } }
      specular { constant: 0.05 } specularness: 0.1 hall_greenberg {} fresnel { schlick {} }
    }
    object { name: "a" material: "paint" sphere { center { x: -0.6 y: 0.5 } radius: 0.5 } }
    object { name: "b" material: "gold" sphere { center { x: 0.6 y: 0.5 } radius: 0.5 } }
    object { name: "c" material: "floor" quad { corner { x: -3 z: 3 } u { x: 6 } v { z: -6 } } }
  )";
}

const char* const red = "samples { wavelength: [400, 580, 620, 700] value: [0.05, 0.1, 0.7, 0.8] }";

class Relit : public testing::Test {
 protected:
  /// X Y Z of what `metamer` with these words writes.
  Image picture(std::vector<std::string> words) {
    const std::string file = folder / "picture.exr";
    words.insert(words.end(), {"--exr", "xyz", "-o", file});
    const Ended ended = words[0] == "relight" ? metamer(words) : daemon.metamer(words);
    EXPECT_EQ(ended.code, 0) << ended.err;
    auto image = read_image(file);
    EXPECT_TRUE(image) << image.error().message;
    return std::move(*image);
  }

  std::string keep() {
    const std::string scene = folder.write("scene.txtpb", scene_text(red, "standard: \"D65\""));
    const std::string file = folder / "kept.factors";
    picture({"render", scene, "--keep-factors=" + file});
    return file;
  }

  /// What mirrors show, exact may carry as bands, and relighting integrates.
  void expect_same(const Image& relit, const Image& rendered, double within = 1e-5) {
    ASSERT_EQ(relit.pixels.size(), rendered.pixels.size());
    double brightest = 0;
    for (std::size_t i = 0; i < rendered.pixels.size(); ++i) {
      const double value = rendered.pixels[i];
      brightest = std::max(brightest, value);
      EXPECT_NEAR(relit.pixels[i], value, within * std::max(1.0, std::abs(value))) << i;
    }
    EXPECT_GT(brightest, 0.1);
  }

  Daemon daemon;
  Folder folder;
};

TEST_F(Relit, WithNothingChangedIsThePictureThatWasRendered) {
  const std::string factors = keep();
  expect_same(picture({"relight", factors}), picture({"render", folder / "scene.txtpb"}));
}

TEST_F(Relit, ByAnotherLightIsThePictureRenderedByIt) {
  const std::string factors = keep();
  const std::string scene = folder.write("f11.txtpb", scene_text(red, "standard: \"F11\""));
  expect_same(picture({"relight", factors, "--light", "key=F11"}), picture({"render", scene}));
}

TEST_F(Relit, WithAnotherPaintIsThePictureRenderedWithIt) {
  const std::string factors = keep();
  const std::string blue = folder.write("blue.txt", "400 0.8\n500 0.5\n600 0.1\n700 0.05\n");
  const std::string scene = folder.write(
      "blue.txtpb",
      scene_text("samples { wavelength: [400, 500, 600, 700] value: [0.8, 0.5, 0.1, 0.05] }",
                 "standard: \"D65\""));
  expect_same(picture({"relight", factors, "--material", "paint=" + blue}),
              picture({"render", scene}));
}

TEST_F(Relit, OfABispectralMatrixIsThePictureRenderedByAnotherLight) {
  folder.write("glow.csv", "excitation,420,450,500\n300,.001,.002,0\n400,.002,.004,.001\n");
  const auto scene = [&](const std::string& name, const std::string& light) {
    std::string text = scene_text(red, light);
    const std::size_t at = text.find("fluorescence {"), end = text.find("quantum_yield: 0.8");
    text.replace(at, end + 18 - at, "fluorescence { file: \"glow.csv\"");
    return folder.write(name, text);
  };
  const std::string file = folder / "matrix.factors";
  picture({"render", scene("d65.txtpb", "standard: \"D65\""), "--keep-factors=" + file});
  expect_same(picture({"relight", file, "--light", "key=A"}),
              picture({"render", scene("a.txtpb", "standard: \"A\"")}));
}

TEST_F(Relit, SendsOutNoMoreThanComes) {
  const std::string white = folder.write("white.txt", "400 0.95\n700 0.95\n");
  const Ended ended =
      metamer({"relight", keep(), "--material", "paint=" + white, "-o", folder / "x.png"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_NE(ended.err.find("of \"paint\" more light comes out than in at 370 nm"),
            std::string::npos)
      << ended.err;
}

TEST_F(Relit, ForAnotherObserverIsThePictureRenderedForIt) {
  const std::string factors = keep();
  expect_same(picture({"relight", factors, "--observer", "cie-1964-10deg"}),
              picture({"render", folder / "scene.txtpb", "--observer", "cie-1964-10deg"}));
}

TEST_F(Relit, FromAFetchedJobIsTheSame) {
  const std::string scene = folder.write("scene.txtpb", scene_text(red, "standard: \"D65\""));
  const Ended submitted = daemon.metamer({"submit", scene, "--keep-factors"});
  ASSERT_EQ(submitted.code, 0) << submitted.err;
  const std::string factors = folder / "fetched.factors";
  const Image fetched = picture({"fetch", "1", "--keep-factors=" + factors});
  expect_same(picture({"relight", factors}), fetched);
}

TEST_F(Relit, ASpectralPictureIsSeenAsTheOneInXyz) {
  const std::string scene = folder.write("scene.txtpb", scene_text(red, "standard: \"D65\""));
  const std::string spectral = folder / "spectral.exr";
  const Ended ended =
      daemon.metamer({"render", scene, "--exr", "spectral:360:830:1", "-o", spectral});
  ASSERT_EQ(ended.code, 0) << ended.err;
  const auto seen = read_xyz(spectral, {});
  ASSERT_TRUE(seen) << seen.error().message;
  EXPECT_EQ(seen->what, "an emission at 471 wavelengths");
  // A band has the mean of its light and the reflectance at its place.
  expect_same(seen->image, picture({"render", scene}), 2e-5);
}

TEST_F(Relit, SaysWhatItDoesNotKnow) {
  const std::string factors = keep();
  const auto refused = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"relight", factors, "-o", folder / "x.png"});
    const Ended ended = metamer(words);
    EXPECT_EQ(ended.code, 2) << ended.err;
    return ended.err;
  };
  EXPECT_NE(refused({"--light", "kez=F11"}).find("did you mean \"key\""), std::string::npos);
  EXPECT_NE(refused({"--material", "pain=TCS09"}).find("did you mean \"paint\""),
            std::string::npos);
  EXPECT_NE(refused({"--light", "key=F99"}).find("F99"), std::string::npos);
  const std::string bright = folder.write("bright.txt", "400 0.8\n500 1.5\n");
  EXPECT_NE(refused({"--material", "paint=" + bright}).find("1.5 at 500 nm"), std::string::npos);
}

TEST_F(Relit, NamesMayHaveEqualsSigns) {
  std::string text = scene_text(red, "standard: \"D65\"");
  text.replace(text.find("\"key\""), 5, "\"a=b\"");
  const std::string scene = folder.write("equals.txtpb", text);
  const std::string file = folder / "equals.factors";
  picture({"render", scene, "--keep-factors=" + file});
  const std::string f11 = folder.write("f11.txtpb", scene_text(red, "standard: \"F11\""));
  expect_same(picture({"relight", file, "--light", "a=b=F11"}), picture({"render", f11}));
}

TEST_F(Relit, ByManyLightsIsAsByEachAlone) {
  const std::string factors = keep();
  const std::string lamps =
      folder.write("lamps.csv", "nm,warm white,cold\n400,1,9\n550,3,5\n700,9,1\n");
  const std::vector<std::pair<std::string, std::string>> lights = {
      {"kept", "kept"},
      {"F11", "F11"},
      {"D:6504K", "D-6504K"},
      {lamps + "#warm white", "lamps-warm-white"}};
  std::vector<std::string> words = {
      "relight", factors, "--exr", "xyz", "--json", "-o", folder / "many-{light}-{material}.exr"};
  for (const auto& [light, name] : lights) words.insert(words.end(), {"--light", "key=" + light});
  words.insert(words.end(),
               {"--light", "fill=D50", "--material", "paint=kept", "--material", "paint=TCS09"});
  const Ended ended = metamer(words);
  ASSERT_EQ(ended.code, 0) << ended.err;
  const Json answer = Json::parse(ended.out);
  EXPECT_EQ(answer["files"].size(), 8U);
  EXPECT_EQ(answer["pictures"][3]["light"], "F11");
  EXPECT_EQ(answer["pictures"][3]["material"], "TCS09");
  for (const auto& [light, name] : lights)
    for (const std::string paint : {"kept", "TCS09"}) {
      const auto many = read_image(folder / ("many-" + name + "-" + paint + ".exr"));
      ASSERT_TRUE(many) << many.error().message;
      EXPECT_EQ(many->pixels, picture({"relight", factors, "--light", "key=" + light, "--light",
                                       "fill=D50", "--material", "paint=" + paint})
                                  .pixels)
          << name << paint;
    }
}

TEST_F(Relit, ByAPixelOfASpectralPictureIsAsByThatLight) {
  const std::string factors = keep();
  const std::string room = folder / "room.exr";
  ASSERT_EQ(metamer({"relight", factors, "--exr", "spectral:360:830:5", "-o", room}).code, 0);
  const Json pixel =
      Json::parse(metamer({"spectra", "info", room + "#10x30-20x35", "--json"}).out)["spectra"][0];
  EXPECT_EQ(pixel["from"], 360);
  EXPECT_EQ(pixel["to"], 830);
  EXPECT_EQ(pixel["format"], "a spectral EXR");
  const std::string light = "key=" + room + "#10x30-20x35";
  expect_same(picture({"relight", factors, "--light", light}),
              picture({"render", folder / "scene.txtpb", "--light", light}));
  for (const char* entry : {"", "#48x0", "#0x40", "#1", "#axb", "#1x1-", "#-1x2", "#1x1-2x2x"}) {
    const Ended ended = metamer({"spectra", "info", room + entry});
    EXPECT_EQ(ended.code, 2) << entry;
    EXPECT_NE(ended.err.find("pixel"), std::string::npos) << ended.err;
  }
}

TEST_F(Relit, AsASheetSaysHowFarCandidatesAreFromTheFirst) {
  const std::string factors = keep();
  const std::string sheet = folder / "sheet.png";
  std::vector<std::string> words = {"relight", factors, "--sheet", sheet, "--json"};
  for (const char* light : {"key=D65", "key=A"}) words.insert(words.end(), {"--light", light});
  for (const char* paint : {"paint=TCS01", "paint=TCS02", "paint=TCS01"})
    words.insert(words.end(), {"--material", paint});
  const Ended ended = metamer(words);
  ASSERT_EQ(ended.code, 0) << ended.err;
  const Json answer = Json::parse(ended.out);
  ASSERT_EQ(answer["pictures"].size(), 6U);
  EXPECT_FALSE(answer["pictures"][0].contains("de00")) << "the reference";
  for (const std::size_t light : {0, 1}) {
    EXPECT_GT(answer["pictures"][3 * light + 1]["de00"]["maximum"], 3);
    EXPECT_GT(answer["pictures"][3 * light + 1]["de00"]["share"], 0.05);
    EXPECT_LT(answer["pictures"][3 * light + 1]["de00"]["share"], 0.9);
    EXPECT_EQ(answer["pictures"][3 * light + 2]["de00"]["maximum"], 0) << "the same paint";
  }
  const auto drawn = read_image(sheet);
  ASSERT_TRUE(drawn);
  EXPECT_GT(drawn->width, 2 * 300);
  EXPECT_GT(drawn->height, 3 * 250);
  // What compare says of the same two pictures.
  std::string files[2];
  for (const int i : {0, 1}) {
    files[i] = folder / (std::to_string(i) + ".exr");
    ASSERT_EQ(metamer({"relight", factors, "--light", "key=A", "--material",
                       i == 0 ? "paint=TCS01" : "paint=TCS02", "--exr", "xyz", "-o", files[i]})
                  .code,
              0);
  }
  const Ended compared = metamer({"compare", files[0], files[1], "--white", "A", "--json"});
  EXPECT_NEAR(Json::parse(compared.out)["difference"]["maximum"].get<double>(),
              answer["pictures"][4]["de00"]["maximum"].get<double>(), 1e-4);
}

TEST_F(Relit, ManyPicturesNeedManyNames) {
  const std::string factors = keep();
  const auto error_of = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {"relight", factors});
    const Ended ended = metamer(words);
    EXPECT_EQ(ended.code, 2) << ended.out;
    return ended.err;
  };
  const std::string x = folder / "x.png";
  EXPECT_NE(error_of({"--light", "key=A", "--light", "key=E", "-o", x}).find("needs {light}"),
            std::string::npos);
  EXPECT_NE(error_of({"--material", "paint=TCS01", "--material", "paint=TCS02", "-o", x})
                .find("needs {material}"),
            std::string::npos);
  EXPECT_NE(error_of({"--light", "key=A", "--light", "key=A", "-o", folder / "{light}.png"})
                .find("two pictures would be called"),
            std::string::npos);
  EXPECT_NE(error_of({"--light", "key=A", "--light", "key=E", "--light", "key=B", "--light",
                      "fill=A", "--light", "fill=E", "-o", folder / "{light}.png"})
                .find("\"fill\" is given 2 spectra and another 3"),
            std::string::npos);
  EXPECT_NE(error_of({"--light", "key=A"}).find("-o FILE or --sheet FILE"), std::string::npos);
  EXPECT_NE(error_of({"--sheet", folder / "x.exr"}).find("does not end in .png"),
            std::string::npos);
}

TEST_F(Relit, SaysWhatHasNoEffect) {
  // The gold's highlight is of its n and k, and it has no diffuse part.
  const Ended ended =
      metamer({"relight", keep(), "--material", "gold.specular=TCS05", "-o", folder / "x.png"});
  EXPECT_EQ(ended.code, 0);
  EXPECT_NE(ended.err.find("\"gold.specular\" has no effect"), std::string::npos) << ended.err;
}

TEST_F(Relit, APictureOutlivesItsFactors) {
  // Two facing mirrors of n and k: each reflection doubles the products.
  const std::string scene = folder.write("facing.txtpb", R"(
    camera { eye { z: 0.5 } target { x: 0.3 z: -1 } }
    settings { width: 32 height: 32 spp: 4 depth: 16 }
    light { name: "l" position { y: 0.5 z: 0.4 } spectrum { standard: "D65" } }
    material {
      name: "gold" diffuseness: 0.5 specularness: 0.5 mirror: 0.9 cook_torrance {}
      diffuse { constant: 0.5 } fresnel { conductor { metal: "Au" } }
    }
    object { name: "a" material: "gold" quad { corner { x: -2 y: -2 z: -1 } u { x: 4 } v { y: 4 } } }
    object { name: "b" material: "gold" quad { corner { x: 2 y: -2 z: 1 } u { x: -4 } v { y: 4 } } }
  )");
  const std::string file = folder / "facing.exr", factors = folder / "facing.factors";
  const Ended ended =
      daemon.metamer({"render", scene, "-o", file, "--exr", "xyz", "--keep-factors=" + factors});
  EXPECT_EQ(ended.code, 1);
  EXPECT_NE(ended.err.find("more factors than are kept"), std::string::npos) << ended.err;
  EXPECT_TRUE(read_image(file));
  EXPECT_FALSE(std::filesystem::exists(factors));
}

TEST_F(Relit, FactorsOverwriteNoOtherFile) {
  const std::string scene = folder.write("scene.txtpb", scene_text(red, "standard: \"D65\""));
  const Ended ended =
      daemon.metamer({"render", scene, "-o", folder / "a.png", "--keep-factors=" + scene});
  EXPECT_EQ(ended.code, 2);
  EXPECT_NE(ended.err.find("does not end in .factors"), std::string::npos) << ended.err;
}

TEST_F(Relit, NeedsFactors) {
  const std::string scene = folder.write("scene.txtpb", scene_text(red, "standard: \"D65\""));
  ASSERT_EQ(daemon.metamer({"submit", scene}).code, 0);
  const Ended ended = daemon.metamer({"fetch", "1", "-o", folder / "x.png", "--keep-factors"});
  EXPECT_EQ(ended.code, 2);
  EXPECT_NE(ended.err.find("submit it with --keep-factors"), std::string::npos) << ended.err;
}

}  // namespace
}  // namespace metamer::test
