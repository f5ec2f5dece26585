// How a picture's X Y Z become RGB: said with the scene, on the command line, or when it is
// fetched.
#include <gtest/gtest.h>

#include <cmath>

#include "common/color/adaptation.h"
#include "common/color/rgb_space.h"
#include "daemon.h"
#include "scenes.h"

namespace metamer::test {
namespace {

class Development : public testing::Test {
 protected:
  Daemon daemon;
  Folder folder;
  std::string scene = folder.write("scene.txtpb", small_scene());

  Image render(const std::vector<std::string>& words) {
    const std::string file = folder / "a.exr";
    std::vector<std::string> all = {"render", scene, "--light", "*=A", "-o", file};
    all.insert(all.end(), words.begin(), words.end());
    EXPECT_EQ(daemon.metamer(all).code, 0);
    return read_exr(file);
  }
};

TEST_F(Development, AdaptsFromTheDominantLightToTheSpacesWhite) {
  const Image xyz = render({"--exr", "xyz"});
  const Image rgb = render({"--adapt", "cmccat2000", "--rgb", "rec-2020"});
  const RgbSpace& space = rgb_space(StandardSpace::rec_2020);
  // CIE 15:2004, table T.3: the white of A.
  const Matrix3 matrix =
      multiply(space.from_xyz, *adaptation_matrix(Adaptation::cmccat2000, {1.09847, 1, 0.35582},
                                                  white_xyz(space.primaries.white)));
  ASSERT_EQ(xyz.pixels.size(), rgb.pixels.size());
  ASSERT_EQ(rgb.channels, (std::vector<std::string>{"R", "G", "B"}));
  expect_a_picture(rgb);
  for (int y = 0; y < xyz.height; ++y)
    for (int x = 0; x < xyz.width; ++x) {
      const float* from = xyz.at(x, y);
      const Rgb expected = multiply(matrix, Xyz{from[0], from[1], from[2]});
      for (std::size_t c = 0; c < 3; ++c)
        ASSERT_NEAR(rgb.at(x, y)[c], expected[c], 2e-4 * (1 + std::abs(expected[c])));
    }
}

TEST_F(Development, CanBeChangedWhenThePictureIsFetched) {
  const Image rendered = render({"--adapt", "sharp", "--rgb", "prophoto"});
  const std::string file = folder / "fetched.exr";
  EXPECT_EQ(daemon.metamer({"submit", scene, "--light", "*=A"}).code, 0);
  const Json answer =
      daemon.json({"fetch", "2", "--adapt", "sharp", "--rgb", "prophoto", "-o", file});
  EXPECT_EQ(answer["exit_code"], 0);
  expect_same_pixels(read_exr(file), rendered, "fetched and rendered");
}

TEST_F(Development, IntoPngsOf16BitsIsAFractionOfAStepOff) {
  const Image exact = render({});
  const std::string file = folder / "a.png";
  for (const auto& [bits, steps] : {std::pair("8", 255.0), std::pair("16", 65535.0)}) {
    ASSERT_EQ(daemon.metamer({"render", scene, "--light", "*=A", "-o", file, "--png", bits}).code,
              0);
    const auto back = read_image(file);
    ASSERT_TRUE(back);
    for (std::size_t i = 0; i < exact.pixels.size(); ++i) {
      const double code = encode(rgb_space(StandardSpace::srgb).transfer, exact.pixels[i]);
      if (code < 0 || code > 1) continue;
      ASSERT_NEAR(back->pixels[i] * steps, code * steps, 0.51) << bits;
    }
  }
  EXPECT_EQ(daemon.metamer({"render", scene, "-o", file, "--png", "12"}).code, 2);
}

TEST_F(Development, OfAWordThatNamesNothingIsBadInput) {
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"render", scene, "--rgb", "srgp", "-o", folder / "a.png"},
        {"fetch", "1", "--rgb", "srgp", "-o", folder / "a.png"},
        {"fetch", "1", "--adapt", "srgp", "-o", folder / "a.png"}}) {
    const Ended ended = daemon.metamer(words);
    EXPECT_EQ(ended.code, 2);
    EXPECT_NE(ended.err.find("named \"srgp\""), std::string::npos) << ended.err;
  }
}

}  // namespace
}  // namespace metamer::test
