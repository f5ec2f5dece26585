// What a problem says can be put in the place of what stands there. That it mends the problem is
// expected of every one that the tests of this folder find: expect_offer_mends.
#include <gtest/gtest.h>

#include "common/scene/validate.h"
#include "scene_text.h"

namespace metamer::test {
namespace {

/// "was -> meant" of the only problem of a scene, located in its text.
std::string offer(const SceneText& scene) {
  const std::string text = scene.all();
  const auto file = SceneFile::parse(text, "s.txtpb");
  const std::vector<Problem> problems =
      file ? validate_scene(file->scene()) : std::vector<Problem>{file.error()};
  EXPECT_EQ(problems.size(), 1u) << text;
  if (problems.size() != 1) return {};
  const Problem problem = file ? file->locate(problems[0]) : problems[0];
  expect_offer_mends(text, problem);
  return problem.was + " -> " + problem.meant;
}

TEST(SceneOffers, ANearMatchForAName) {
  EXPECT_EQ(offer({.object = "object { material: \"gray\" sphere { radius: 1 } }"}),
            "gray -> grey");
  EXPECT_EQ(offer({.object = "object { material: \"grey\" spehre { radius: 1 } }"}),
            "spehre -> sphere");
  EXPECT_EQ(offer({.settings = "settings { observer: CIE_1931_3DEG }"}),
            "CIE_1931_3DEG -> CIE_1931_2DEG");
  EXPECT_EQ(offer({.light = "light { position { y: 2 } spectrum { standard: \"D66\" } }"}),
            "D66 -> D65");
  EXPECT_EQ(offer({.light = "light { position { y: 2 } spectrum { standard: \"2856\" } }"}),
            "2856 -> 2856K");
  EXPECT_EQ(offer({.material = "material { name: \"grey\" mirror: 1 cook_torrance {} "
                               "fresnel { conductor { metal: \"Agg\" } } }"}),
            "Agg -> Ag");
}

TEST(SceneOffers, TheNearestAllowedForANumberAsItIsWritten) {
  EXPECT_EQ(offer({.settings = "settings { width: 20000 }"}), "20000 -> 16384");
  EXPECT_EQ(offer({.settings = "settings { tile_size: 4000000000 }"}), "4000000000 -> 256");
  EXPECT_EQ(offer({.settings = "settings { tile_size: 3 }"}), "3 -> 8");
  EXPECT_EQ(offer({.settings = "settings { tile_size: 100 }"}), "100 -> 104");
  EXPECT_EQ(offer({.settings = "settings { method { linear { bases: 99 } } }"}), "99 -> 16");
  EXPECT_EQ(offer({.camera = "camera { eye { z: 2.0E15 } }"}), "2.0E15 -> 1e+15");
  EXPECT_EQ(offer({.material = "material { name: \"grey\" mirror: 1.50 }"}), "1.50 -> 1");
  EXPECT_EQ(offer({.material = "material { name: \"grey\" diffuse { constant: -5e-1 } }"}),
            "-5e-1 -> 0");
  EXPECT_EQ(offer({.material = "material { name: \"grey\" diffuse { samples { "
                               "wavelength: [400, 500] value: [0.5, 1.20] } } }"}),
            "1.20 -> 1");
  EXPECT_EQ(offer({.light = "light { position { y: 2 } luminance: -1.0 "
                            "spectrum { standard: \"D65\" } }"}),
            "-1.0 -> 0");
  EXPECT_EQ(offer({.light = "light { position { y: 2 } solid_angle: 13 "
                            "spectrum { standard: \"D65\" } }"}),
            "13 -> 12.566370614359172");
}

TEST(SceneOffers, NothingWhereNothingIsNearOrNoNumberIsTheNearest) {
  EXPECT_EQ(offer({.object = "object { material: \"wood\" sphere { radius: 1 } }"}), " -> ");
  EXPECT_EQ(offer({.object = "object { material: \"grey\" sphere { radius: -1 } }"}), " -> ");
  EXPECT_EQ(offer({.camera = "camera { eye { z: 4 } vertical_fov: 180 }"}), " -> ");
}

}  // namespace
}  // namespace metamer::test
