// A look of a scene file is what its options by hand are, whichever command it is said to.
#include <gtest/gtest.h>

#include "daemon.h"
#include "scenes.h"

namespace metamer::test {
namespace {

const char* const looks_scene = R"(
  camera { eye { y: 1 z: 4 } target { y: 0.4 } }
  settings { width: 24 height: 20 spp: 1 }
  light { name: "key" position { x: -2 y: 4 z: 3 } spectrum { standard: "D65" } }
  light { name: "fill" direction { x: -1 y: -1 z: -1 } luminance: 0.2 spectrum { standard: "A" } }
  material { name: "m" lambert {} diffuse { samples { wavelength: [400, 700] value: [0.2, 0.6] } } }
  object { name: "o" material: "m" sphere { radius: 0.8 } }
  look {
    name: "shop" light { name: "*" spectrum { standard: "F11" } }
    light { name: "key" spectrum { file: "lamp.txt" } }
    observer: CIE_1964_10DEG development { adaptation: BRADFORD rgb_space: DISPLAY_P3 }
  }
  look { name: "nothing" }
)";

class Looks : public testing::Test {
 protected:
  std::vector<float> picture(std::vector<std::string> words) {
    const std::string file = folder / "picture.png";
    words.insert(words.end(), {"-o", file});
    const Ended ended = daemon.metamer(words);
    EXPECT_EQ(ended.code, 0) << ended.err;
    const auto image = read_image(file);
    EXPECT_TRUE(image) << image.error().message;
    return image ? image->pixels : std::vector<float>{};
  }

  Daemon daemon;
  Folder folder;
  std::string lamp = folder.write("lamp.txt", "400 1\n700 2\n");
  std::string scene = folder.write("scene.txtpb", looks_scene);
};

TEST_F(Looks, AreTheSameOptionsByHand) {
  const std::vector<float> plain = picture({"render", scene});
  EXPECT_EQ(picture({"render", scene, "--look", "nothing"}), plain);
  const std::vector<float> shop = picture({"render", scene, "--look", "shop"});
  EXPECT_NE(shop, plain);
  EXPECT_EQ(picture({"render", scene, "--light", "*=F11", "--light", "key=" + lamp, "--observer",
                     "cie-1964-10deg", "--adapt", "bradford", "--rgb", "display-p3"}),
            shop);
  // Options come after it.
  EXPECT_EQ(picture({"render", scene, "--look", "shop", "--light", "key=D65", "--light", "fill=A",
                     "--observer", "cie-1931-2deg"}),
            picture({"render", scene, "--adapt", "bradford", "--rgb", "display-p3"}));
}

TEST_F(Looks, AreTakenByAllThatTakeAScene) {
  const std::string png = folder / "view.png";
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"check", scene},
                                             {"explain", scene},
                                             {"submit", scene},
                                             {"view", scene, "--record", "2", "-o", png},
                                             {"tradeoff", scene, "-o", folder / "trade"}}) {
    std::vector<std::string> wrong = words;
    wrong.insert(wrong.end(), {"--look", "shp"});
    const Ended refused = daemon.metamer(wrong);
    EXPECT_EQ(refused.code, 2) << words[0];
    EXPECT_NE(refused.err.find("--look: no look named \"shp\"; did you mean \"shop\"?"),
              std::string::npos)
        << words[0] << refused.err;
  }
  EXPECT_EQ(daemon.metamer({"view", scene, "--look", "shop", "--record", "2", "-o", png}).code, 0);
}

TEST_F(Looks, AreListedByCheck) {
  const Ended ended = daemon.metamer({"check", scene});
  EXPECT_EQ(ended.code, 0) << ended.err;
  EXPECT_NE(ended.out.find("looks: shop, nothing\n"), std::string::npos) << ended.out;
}

}  // namespace
}  // namespace metamer::test
