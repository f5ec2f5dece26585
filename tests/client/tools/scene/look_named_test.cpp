// A look of a scene is a set of changes like any other.
#include <google/protobuf/text_format.h>
#include <gtest/gtest.h>

#include "client/cli/overrides.h"
#include "client/session/submission.h"
#include "client/tools/scene/checked_scene.h"
#include "client/tools/scene/look.h"

namespace metamer::client {
namespace {

v1::Scene scene_of(const std::string& looks) {
  v1::Scene scene;
  EXPECT_TRUE(google::protobuf::TextFormat::ParseFromString(
      R"(camera { eye { z: 4 } vertical_fov: 20 }
      light { name: "key" spectrum { standard: "D65" } luminance: 0.5 } light { name: "fill" }
      material { name: "m" diffuse { constant: 0.5 } } object { name: "o" material: "m" }
      settings { observer_file: "eye.csv" development { linear: true rgb_space: ADOBE_RGB } })" +
          looks,
      &scene));
  return scene;
}

/// The scene after its look "x", without looks.
v1::Scene with_look(const std::string& look) {
  v1::Scene scene = scene_of("look { name: 'x' " + look + " }");
  const auto changes = look_named(scene, "x");
  EXPECT_TRUE(changes);
  EXPECT_TRUE(apply(*changes, scene));
  scene.clear_look();
  return scene;
}

TEST(LookNamed, OneOfNothingChangesNothing) {
  EXPECT_EQ(with_look("").DebugString(), scene_of("").DebugString());
  EXPECT_EQ(with_look("development {}").DebugString(), scene_of("").DebugString());
}

TEST(LookNamed, ChangesWhatItSaysAndNothingElse) {
  v1::Scene expected = scene_of("");
  expected.mutable_light(0)->mutable_spectrum()->set_standard("A");
  expected.mutable_light(1)->mutable_spectrum()->set_standard("F11");
  expected.mutable_light(1)->set_luminance(0);
  EXPECT_EQ(with_look("light { name: '*' spectrum { standard: 'A' } } "
                      "light { name: 'fill' spectrum { standard: 'F11' } luminance: 0 }")
                .DebugString(),
            expected.DebugString());

  expected = scene_of("");
  expected.mutable_material(0)->mutable_specular()->set_constant(0);
  EXPECT_EQ(with_look("material { name: 'm' specular { constant: 0 } }").DebugString(),
            expected.DebugString());

  expected = scene_of("");
  expected.mutable_camera()->Clear();
  expected.mutable_camera()->mutable_eye()->set_x(1);
  EXPECT_EQ(with_look("camera { eye { x: 1 } }").DebugString(), expected.DebugString());
}

TEST(LookNamed, AnObserverTakesThePlaceOfAFileAndAFileThatOfAnObserver) {
  const v1::Settings cie = with_look("observer: CIE_1931_2DEG").settings();
  EXPECT_EQ(cie.observer_file(), "");
  EXPECT_EQ(with_look("observer: CIE_1964_10DEG").settings().observer(), v1::CIE_1964_10DEG);
  v1::Scene scene = scene_of("look { name: 'x' observer_file: 'mine.csv' }");
  scene.mutable_settings()->set_observer(v1::CIE_1964_10DEG);
  ASSERT_TRUE(apply(*look_named(scene, "x"), scene));
  EXPECT_EQ(scene.settings().observer_file(), "mine.csv");
  EXPECT_EQ(scene.settings().observer(), v1::CIE_1931_2DEG);
}

TEST(LookNamed, OfADevelopmentWhatItSaysCounts) {
  EXPECT_EQ(
      with_look("development { adaptation: BRADFORD }").settings().development().ShortDebugString(),
      "adaptation: BRADFORD rgb_space: ADOBE_RGB linear: true");
  EXPECT_EQ(with_look("development { adaptation: NO_ADAPTATION rgb_space: SRGB }")
                .settings()
                .development()
                .ShortDebugString(),
            "adaptation: NO_ADAPTATION rgb_space: SRGB linear: true");
  // Primaries are replaced as a whole: lists would grow, and a gamma stay, else.
  v1::Scene scene = scene_of(
      "look { name: 'x' development { primaries { red: [0.6, 0.3] green: [0.3, 0.6] "
      "blue: [0.15, 0.06] white: [0.3, 0.3] } } }");
  *scene.mutable_settings()->mutable_development() = scene.look(0).development();
  scene.mutable_settings()->mutable_development()->mutable_primaries()->set_gamma(2);
  ASSERT_TRUE(apply(*look_named(scene, "x"), scene));
  EXPECT_EQ(scene.settings().development().ShortDebugString(),
            scene.look(0).development().ShortDebugString());
}

TEST(LookNamed, SaysWhatWasPerhapsMeantOrWhatThereIs) {
  const v1::Scene scene = scene_of("look { name: 'shop' } look { name: 'D65' }");
  EXPECT_EQ(look_named(scene, "shp").error().message,
            "no look named \"shp\"; did you mean \"shop\"?");
  EXPECT_EQ(look_named(scene, "evening").error().message,
            "no look named \"evening\"; there are \"shop\", \"D65\"");
  EXPECT_EQ(look_named(scene_of(""), "A").error().message,
            "the scene has no looks, so none named \"A\"");
}

TEST(LookNamed, OptionsComeAfterItAndAreTheSameByHand) {
  cli::Overrides overrides;
  overrides.look = "x";
  overrides.lights = {"key=F11"};
  v1::Scene scene = scene_of("look { name: 'x' light { name: '*' spectrum { standard: 'A' } } }");
  const auto replaced = cli::apply(overrides, scene);
  ASSERT_TRUE(replaced);
  EXPECT_EQ(replaced_by(*replaced, "light[0].spectrum.standard"), "--light");
  EXPECT_EQ(replaced_by(*replaced, "light[1].spectrum.standard"), "look \"x\"");

  cli::Overrides by_hand;
  by_hand.lights = {"*=A", "key=F11"};
  v1::Scene other = scene_of("");
  ASSERT_TRUE(cli::apply(by_hand, other));
  EXPECT_EQ(make_submission(scene, {}, "s", false).uploads[0].bytes,
            make_submission(other, {}, "s", false).uploads[0].bytes);
  overrides.look = "evening";
  EXPECT_EQ(cli::apply(overrides, scene).error().message,
            "--look: no look named \"evening\"; there are \"x\"");
}

const char* const looks_text = R"(camera { eye { z: 4 } target {} }
light { name: "lamp" position { z: 4 } spectrum { standard: "D65" } }
light { name: "lamp 2" position { z: 4 } spectrum { standard: "D65" } }
material { name: "m" diffuse { constant: 1 } }
object { name: "o" material: "m" sphere { radius: 1 } }
look { name: "dark" light { name: "*"
  spectrum { constant: 0 } } }
look { name: "lost" light { name: "lump" luminance: 1 } }
)";

TEST(LookNamed, ItsProblemsStandInTheSceneOnce) {
  DigestCache digests;
  const auto checked = [&](const std::string& name) {
    return CheckedScene::parse(looks_text, "s.txtpb", digests, [name](v1::Scene& scene) {
      cli::Overrides overrides;
      if (!name.empty()) overrides.look = name;
      return cli::apply(overrides, scene);
    });
  };
  // Used or not, a look is at fault where it stands.
  for (const std::string name : {"", "dark"}) {
    const CheckedScene scene = checked(name);
    ASSERT_EQ(scene.problems().size(), 2u) << name;
    EXPECT_EQ(scene.problems()[0].line, 7) << name;
    EXPECT_EQ(scene.problems()[0].message, "an emission must not be 0 at every wavelength");
    EXPECT_EQ(scene.problems()[1].line, 8) << name;
  }
  const CheckedScene lost = checked("lost");
  ASSERT_EQ(lost.problems().size(), 1u);
  EXPECT_EQ(lost.problems()[0].message, "no light named \"lump\"; did you mean \"lamp\"?");
  EXPECT_EQ(lost.problems()[0].line, 8);
  // So does what a server finds in the scene that it was sent.
  const Problem found =
      checked("dark").locate({.field = "light[1].spectrum.constant", .file = {}, .message = "odd"});
  EXPECT_EQ(found.field, "look[0].light[0].spectrum.constant");
  EXPECT_EQ(found.line, 7);
}

TEST(LookNamed, NoneIsSent) {
  const v1::Scene scene = scene_of("look { name: 'x' }");
  EXPECT_EQ(make_submission(scene, {}, "s", false).uploads[0].bytes, serialise(scene_of("")));
}

}  // namespace
}  // namespace metamer::client
