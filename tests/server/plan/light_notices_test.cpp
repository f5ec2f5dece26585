#include "server/plan/light_notices.h"

#include <gtest/gtest.h>

#include "common/scene/settings.h"
#include "server/plan/plan.h"
#include "server/scene/camera_space.h"
#include "tests/server/test_scene.h"

namespace metamer {
namespace {

/// What the plan of a scene says at a light, where the object is as given.
std::string said_of(const std::string& light, const std::string& object,
                    const std::string& eye = "z: 9") {
  const std::string text = "camera { eye { " + eye + " } target { x: 0.1 } } light { name: 'l' " +
                           light +
                           " spectrum { standard: 'E' } } material { name: 'm' } object { "
                           "name: 'o' material: 'm' " +
                           object + " } ";
  RenderScene scene = test::compile_text(text);
  CameraSpace::of(scene).place(scene);
  const v1::Plan plan =
      make_plan(scene, with_defaults(test::parse_scene(text).settings()), {.threads = 1});
  std::string said;
  for (const v1::Notice& notice : plan.notice())
    if (notice.field() == "light[0]" && !notice.message().starts_with("a pixel looks at"))
      said += notice.message() + "\n";
  return said;
}

constexpr const char* floor_below = "quad { corner { x: -1 y: -1 z: 1 } u { x: 2 } v { z: -2 } }";
constexpr const char* faces_up = "quad { corner { z: 1 } u { x: 1 } v { z: -1 } }";
constexpr const char* faces_down = "quad { corner { z: 1 } u { z: -1 } v { x: 1 } }";

TEST(LightNotices, AQuadThatFacesAwayFromAllObjectsIsSaid) {
  EXPECT_NE(said_of(faces_up, floor_below).find("no object is in front of it"), std::string::npos);
  EXPECT_EQ(said_of(faces_down, floor_below), "");
  EXPECT_NE(
      said_of(faces_up, "sphere { center { y: -2 } radius: 1.9 }").find("no object is in front"),
      std::string::npos);
  EXPECT_EQ(said_of(faces_up, "sphere { center { y: -2 } radius: 2.1 }"), "")
      << "its top is before it";
  EXPECT_EQ(said_of(faces_up,
                    "sphere { center { y: -2 } radius: 1 } transform { scale { x: 1 y: 3 z: 1 "
                    "} }"),
            said_of(faces_up, floor_below));
  EXPECT_EQ(said_of(faces_up,
                    "sphere { radius: 1 } transform { scale { x: 1 y: 3 z: 1 } } transform { "
                    "translate { y: -2 } }"),
            "")
      << "an ellipsoid's top, too";
}

TEST(LightNotices, ADiskInAPlaneLightsNothingOfItAndATiltedOneDoes) {
  EXPECT_NE(said_of("disk { normal { y: 1 } }", "plane {}").find("no object is in front"),
            std::string::npos);
  EXPECT_NE(said_of("disk { center { y: 1 } normal { y: 1 } }", "plane {}").find("no object"),
            std::string::npos);
  EXPECT_EQ(said_of("disk { center { y: 1 } normal { y: -1 } }", "plane {}"), "");
  EXPECT_EQ(said_of("disk { center { y: 1 } normal { x: 0.01 y: 1 } }", "plane {}"), "");
}

TEST(LightNotices, ASphereAboutAllObjectsOrTheEyeIsSaid) {
  const std::string about = "sphere { radius: 5 }";
  const std::string inside = "all objects are inside it: it shines outwards alone\n";
  EXPECT_EQ(said_of(about, floor_below), inside);
  EXPECT_EQ(said_of(about, "sphere { center { x: 4.5 } radius: 1 }"), "");
  EXPECT_EQ(said_of(about, "plane {}"), "");
  const std::string eye =
      "the eye is inside it: it shines outwards alone, so that what is inside is dark\n";
  EXPECT_EQ(said_of(about, "plane {}", "z: 4"), eye);
  EXPECT_EQ(said_of(about, floor_below, "z: 4"), inside + eye);
}

TEST(LightNotices, ALightTooSmallForItsProductsIsSaid) {
  for (const std::string light : {"sphere { center { y: 1 } radius: %s }",
                                  "disk { center { y: 1 } normal { y: -1 } radius: %s }",
                                  "quad { corner { y: 1 } u { z: -%s } v { x: %s } }"}) {
    const auto of = [&](const std::string& size) {
      std::string text = light;
      for (std::size_t at; (at = text.find("%s")) != std::string::npos;) text.replace(at, 2, size);
      return said_of(text, floor_below);
    };
    EXPECT_EQ(of("1e-15"), "") << light;
    EXPECT_NE(of("1e-19").find("sends no light"), std::string::npos) << light;
  }
}

TEST(LightNotices, LightsThatArePlacesSayNothing) {
  EXPECT_EQ(said_of("position { y: -5 }", floor_below), "");
  EXPECT_EQ(said_of("direction { y: 1 }", floor_below), "");
}

}  // namespace
}  // namespace metamer
