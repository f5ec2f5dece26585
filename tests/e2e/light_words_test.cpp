// A light is the same by one word, whichever command it is said to.
#include <gtest/gtest.h>

#include "common/image/image.h"
#include "daemon.h"

namespace metamer::test {
namespace {

const char* const scene_text = R"(
  camera { eye { y: 1 z: 4 } target { y: 0.4 } }
  settings { width: 24 height: 20 spp: 1 }
  light { name: "key" position { x: -2 y: 4 z: 3 } spectrum { standard: "D65" } }
  light { name: "a=b" direction { x: -1 y: -1 z: -1 } luminance: 0.2 spectrum { file: "lamp.txt" } }
  material { name: "m" lambert {} diffuse { samples { wavelength: [400, 700] value: [0.2, 0.6] } } }
  object { name: "o" material: "m" sphere { radius: 0.8 } }
)";

class LightWords : public testing::Test {
 protected:
  LightWords() {
    folder.write("lamp.txt", "400 1\n700 2\n");
    scene = folder.write("scene.txtpb", scene_text);
    factors = folder / "kept.factors";
    const Ended kept = daemon.metamer(
        {"render", scene, "--keep-factors=" + factors, "-o", folder / "kept.exr", "--exr", "xyz"});
    EXPECT_EQ(kept.code, 0) << kept.err;
  }

  std::vector<float> picture(std::vector<std::string> words, std::string* said = nullptr) {
    const std::string file = folder / "picture.exr";
    words.insert(words.end(), {"--exr", "xyz", "-o", file});
    const Ended ended = words[0] == "relight" ? metamer(words) : daemon.metamer(words);
    EXPECT_EQ(ended.code, 0) << ended.err;
    if (said != nullptr) *said = ended.err;
    auto image = read_image(file);
    EXPECT_TRUE(image) << image.error().message;
    return image ? image->pixels : std::vector<float>{};
  }

  std::string error_of(std::vector<std::string> words) {
    words.insert(words.end(), {"-o", folder / "x.png"});
    const Ended ended = words[0] == "relight" ? metamer(words) : daemon.metamer(words);
    EXPECT_EQ(ended.code, 2) << ended.err;
    return ended.err;
  }

  Daemon daemon;
  Folder folder;
  std::string scene, factors;
};

TEST_F(LightWords, GiveTheSamePictureByRenderAndByRelight) {
  Folder elsewhere;
  const std::string lamps =
      elsewhere.write("my=lamps.csv", "um;warm;cold\n0,4;1;5\n0,5;2;4\n0,6;5;2\n0,7;9;1\n");
  const std::string noisy = elsewhere.write("noisy.txt", "400 -0.01\n500 20\n600 30\n700 2\n");
  const std::vector<float> before = picture({"render", scene});
  for (const std::string& word : {std::string("F11"), std::string("D:4000K"), std::string("2856K"),
                                  std::string("436nm:0.6+546.1nm+611nm:2"), lamps + "#warm",
                                  lamps + "#cold@um@linear", noisy + "@clamp"})
    for (const std::string name : {"key=", "*="}) {
      const std::vector<float> rendered = picture({"render", scene, "--light", name + word});
      const std::vector<float> relit = picture({"relight", factors, "--light", name + word});
      ASSERT_EQ(rendered.size(), relit.size());
      for (std::size_t i = 0; i < relit.size(); ++i)
        ASSERT_NEAR(relit[i], rendered[i], 1e-5) << name << word << " " << i;
      EXPECT_NE(rendered, before) << name << word;
    }
}

TEST_F(LightWords, SayWhatAFileWasTakenFor) {
  const std::string noisy = folder.write("noisy.txt", "400 -0.01\n500 20\n600 30\n700 2\n");
  for (const std::string command : {"render", "relight"}) {
    std::string said;
    picture({command, command == "render" ? scene : factors, "--light", "key=" + noisy + "@clamp"},
            &said);
    EXPECT_NE(said.find("1 of 4 values were below 0 and are clamped"), std::string::npos) << said;
  }
}

TEST_F(LightWords, ThatAreWrongAreToldAlike) {
  const std::string paint = folder.write("paint.sp", "400 -0.5\n700 0.5\n");
  const std::pair<std::string, std::string> cases[] = {
      {"2856", "a black body of that temperature is \"2856K\""},
      {"D:6504", "daylight of that temperature is \"D:6504K\""},
      {"D66", "did you mean \"D65\""},
      {"1064nm", "a line lies between 360 and 830 nm"},
      {folder / "nothing.csv", "nothing.csv"},
      {paint, "must not be negative (it is -0.5 at 400 nm)"},
      {paint + "@clmap", "did you mean \"clamp\""}};
  for (const auto& [word, hint] : cases) {
    EXPECT_NE(error_of({"render", scene, "--light", "key=" + word}).find(hint), std::string::npos)
        << word << ": " << error_of({"render", scene, "--light", "key=" + word});
    EXPECT_NE(error_of({"relight", factors, "--light", "key=" + word}).find(hint),
              std::string::npos)
        << word << ": " << error_of({"relight", factors, "--light", "key=" + word});
  }
}

TEST_F(LightWords, OfAFileThatIsCalledAsAnotherOfTheScene) {
  Folder elsewhere;
  elsewhere.write("lamp.txt", "400 3\n700 1\n");
  // Names with folders differ.
  EXPECT_EQ(picture({"render", scene, "--light", "key=" + (elsewhere / "lamp.txt")}).empty(),
            false);
  EXPECT_EQ(picture({"render", scene, "--light", "key=" + (folder / "lamp.txt")}).empty(), false);
}

TEST_F(LightWords, WithEqualsSignsAreTakenApart) {
  EXPECT_EQ(picture({"render", scene, "--light", "a=b=F11"}),
            picture({"render", scene, "--light", "a=b=F11", "--light", "key=D65"}));
}

TEST_F(LightWords, APixelOfASpectralPictureIsTheSameInASceneAndByAWord) {
  // What the scene itself shows, as a lamp.
  const std::string room = folder / "room.exr";
  EXPECT_EQ(daemon.metamer({"render", scene, "-o", room, "--exr", "spectral:400:700:20"}).code, 0);
  std::string text = scene_text;
  const std::string before = "spectrum { standard: \"D65\" }";
  text.replace(text.find(before), before.size(),
               "spectrum { file: \"room.exr\" entry: \"12x10-13x11\" }");
  const std::string other = folder.write("other.txtpb", text);
  EXPECT_EQ(daemon.metamer({"check", other}).code, 0);
  const std::vector<float> written = picture({"render", other});
  const std::vector<float> said =
      picture({"render", scene, "--light", "key=" + room + "#12x10-13x11"});
  ASSERT_EQ(written.size(), said.size());
  for (std::size_t i = 0; i < said.size(); ++i) ASSERT_NEAR(written[i], said[i], 1e-5);
  EXPECT_NE(written, picture({"render", scene}));
}

}  // namespace
}  // namespace metamer::test
