// An observer of one's own, from its file to the picture.
#include <gtest/gtest.h>

#include <cmath>

#include "common/spectral/cie.h"
#include "daemon.h"
#include "scenes.h"

namespace metamer::test {
namespace {

/// Every fifth row of an observer of 1 nm, its functions in this order.
std::string table_of(const Observer& observer,
                     const std::array<std::size_t, 3>& order = {0, 1, 2}) {
  const auto& functions = observer.functions();
  std::string text = "nm,x,y,z\n";
  for (std::size_t i = 0; i < functions[0].nm.size(); i += 5) {
    text += number_text(functions[0].nm[i]);
    for (const std::size_t axis : order) text += "," + number_text(functions[axis].values[i]);
    text += "\n";
  }
  return text;
}

class OwnObserverPicture : public testing::Test {
 protected:
  Image picture(std::vector<std::string> words) {
    const std::string file = folder / ("picture" + std::to_string(++count) + ".exr");
    words.insert(words.end(), {"--exr", "xyz", "-o", file});
    const Ended ended = words[0] == "relight" ? metamer(words) : daemon.metamer(words);
    EXPECT_EQ(ended.code, 0) << ended.err;
    return read_exr(file);
  }

  Image rendered(const std::vector<std::string>& more) {
    std::vector<std::string> words = {"render", scene};
    words.insert(words.end(), more.begin(), more.end());
    return picture(words);
  }

  Daemon daemon;
  Folder folder;
  std::string scene = folder.write("scene.txtpb", small_scene());
  int count = 0;
};

TEST_F(OwnObserverPicture, OfTheCiesTableBy5NmIsTheCiesToTheBitByEveryMethod) {
  const std::string two = folder.write("two.csv", table_of(cie::observer_1931()));
  const std::string ten = folder.write("ten.csv", table_of(cie::observer_1964()));
  for (const std::string method : {"exact", "point", "rgb", "linear", "prefilter"}) {
    const Image cie = rendered({"--method", method});
    expect_a_picture(cie);
    expect_same_pixels(cie, rendered({"--method", method, "--observer", two}), method);
    expect_same_pixels(rendered({"--method", method, "--observer", "cie-1964-10deg"}),
                       rendered({"--method", method, "--observer", ten}), method);
  }
}

TEST_F(OwnObserverPicture, ThatTheSceneNamesIsTheSame) {
  folder.write("two.csv", table_of(cie::observer_1931()));
  std::string text = small_scene();
  text.replace(text.find("spp: 4"), 6, "spp: 4 observer_file: 'two.csv'");
  const std::string own = folder.write("own.txtpb", text);
  expect_same_pixels(rendered({}), picture({"render", own}), "named by the scene");
}

TEST_F(OwnObserverPicture, WithXAndZSwappedHasThemSwapped) {
  const std::string file = folder.write("swapped.csv", table_of(cie::observer_1931(), {2, 1, 0}));
  const Image right = rendered({}), swapped = rendered({"--observer", file});
  expect_a_picture(right);
  ASSERT_EQ(right.pixels.size(), swapped.pixels.size());
  for (std::size_t i = 0; i + 2 < right.pixels.size(); i += 3) {
    EXPECT_EQ(swapped.pixels[i], right.pixels[i + 2]);
    EXPECT_EQ(swapped.pixels[i + 1], right.pixels[i + 1]);
    EXPECT_EQ(swapped.pixels[i + 2], right.pixels[i]);
  }
}

TEST_F(OwnObserverPicture, GoesAlongWithItsFactorsAndIsSwappedByRelight) {
  const std::string ten = folder.write("ten.csv", table_of(cie::observer_1964()));
  const std::string factors = folder / "kept.factors";
  const Image kept = rendered({"--observer", ten, "--keep-factors=" + factors});
  const Image relit = picture({"relight", factors});
  const Image by_name = picture({"relight", factors, "--observer", "cie-1964-10deg"});
  expect_same_pixels(relit, by_name, "the observer in the file");
  ASSERT_EQ(relit.pixels.size(), kept.pixels.size());
  for (std::size_t i = 0; i < kept.pixels.size(); ++i)
    EXPECT_NEAR(relit.pixels[i], kept.pixels[i], 1e-5 * std::max(1.0f, kept.pixels[i]));

  const std::string two = folder.write("two.csv", table_of(cie::observer_1931()));
  expect_same_pixels(picture({"relight", factors, "--observer", two}),
                     picture({"relight", factors, "--observer", "cie-1931-2deg"}), "another");
}

TEST_F(OwnObserverPicture, OfOneNarrowLineIsFinite) {
  const std::string file = folder.write("narrow.csv", "555.2 0 0 0\n555.4 0 1 0\n555.6 0 0 0\n");
  for (const std::string method : {"exact", "point", "rgb", "linear", "prefilter"})
    for (const float value : rendered({"--method", method, "--observer", file}).pixels)
      ASSERT_TRUE(std::isfinite(value)) << method;
  expect_a_picture(rendered({"--observer", file}));
}

TEST_F(OwnObserverPicture, OfAHostileFileIsALocatedError) {
  for (const auto& [text, error] :
       {std::pair{"400,1,1,1\n500,1,nan,1\n", ":2:7: error: "},
        std::pair{"400,1,1,1\n400,1,1,1\n", ":2:1: error: "},
        std::pair{"400,1,1,1\n500,1,-1,1\n", ": error: "}, std::pair{"\x7f\x45LF\x01\x02", ":1:"},
        std::pair{"400", ":1:1: error: "}, std::pair{"400,1\n500,1\n", ": error: "}}) {
    const std::string file = folder.write("hostile.csv", text);
    const Ended ended =
        daemon.metamer({"render", scene, "--observer", file, "-o", folder / "x.png"});
    EXPECT_EQ(ended.code, 2);
    EXPECT_NE(ended.err.find(file + error), std::string::npos) << ended.err;
  }
  EXPECT_EQ(daemon.metamer({"render", scene, "-o", folder / "y.png"}).code, 0);
}

TEST_F(OwnObserverPicture, IsNamedByThePlanAndWhatIsCutIsSaid) {
  const std::string file = folder.write("wide.csv", "340,1,1,1\n900,1,1,1\n");
  const Json document =
      daemon.json({"render", scene, "--observer", file, "-o", folder / "wide.exr"});
  EXPECT_EQ(document["plan"]["observer_file"], file);
  const std::string notes = document["plan"]["notice"].dump();
  EXPECT_NE(notes.find("what it sees outside 360 to 830 nm is left out"), std::string::npos)
      << notes;
}

TEST_F(OwnObserverPicture, ServesSpectraAndCompare) {
  const std::string file = folder.write("swapped.csv", table_of(cie::observer_1931(), {2, 1, 0}));
  const Json info =
      parse_document(metamer({"spectra", "info", "D65", "--observer", file, "--json"}).out);
  const Json& light = info["spectra"][0];
  const double x = light["cie-1931-2deg"]["x"], y = light["cie-1931-2deg"]["y"];
  EXPECT_NEAR(light[file]["x"], 1 - x - y, 1e-12);
  EXPECT_NEAR(light[file]["y"], y, 1e-12);

  rendered({});
  const std::string a = folder / "picture1.exr";
  const Json same =
      parse_document(metamer({"compare", a, a, "--white", "A", "--observer", file, "--json"}).out);
  EXPECT_EQ(same["observer"], file);
  EXPECT_NEAR(same["white"]["xyz"][0], 0.3558, 2e-4);  // Z of CIE 15:2004, table T.3
}

}  // namespace
}  // namespace metamer::test
