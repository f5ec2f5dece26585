#include "client/tools/scene/settings_change.h"

#include <google/protobuf/text_format.h>
#include <gtest/gtest.h>

#include "common/scene/settings.h"

namespace metamer::client {
namespace {

v1::Settings settings_of(const char* text) {
  v1::Settings settings;
  EXPECT_TRUE(google::protobuf::TextFormat::ParseFromString(text, &settings)) << text;
  return settings;
}

TEST(SettingsChange, TurnsAnySettingsIntoAnyOthers) {
  // Each kind of field, left out and set, and each choice against the others.
  const std::vector<const char*> all{
      "",
      "width: 20 height: 30 spp: 1 depth: 0 threads: 3 tile_size: 8",
      "observer: CIE_1964_10DEG shading: GOURAUD backend: GL verify: true",
      "observer_file: \"me.csv\"",
      "method { point { step: 10 from: 400 to: 700 } }",
      "method { point { fitted: 4 lights: CELLS multi_pass: true } }",
      "method { point { wavelengths: [450, 550, 650] } }",
      "method { point { wavelengths: [460, 560] } }",
      "method { linear { bases: 7 bounce: true weighting: OBSERVER } }",
      "method { exact {} }",
      "method { rgb {} }",
      "method { prefilter {} }",
      "method { auto { deadline: 3 } }",
      "goal { tolerance: 0.2 }",
      "goal { deadline: 2 }",
      "development { adaptation: BRADFORD rgb_space: REC_2020 linear: true }",
      "development { adaptation: NO_ADAPTATION }",
      "development { primaries { red: [0.6, 0.3] green: [0.2, 0.7] blue: [0.1, 0.1] "
      "white: [0.31, 0.33] gamma: 2 } }",
  };
  for (const char* own : all)
    for (const char* wanted : all) {
      v1::Scene scene;
      *scene.mutable_settings() = settings_of(own);
      Look look;
      set_settings(scene.settings(), settings_of(wanted), "the form", look);
      ASSERT_TRUE(apply(look, scene));
      v1::Settings expected = with_defaults(settings_of(wanted)),
                   got = with_defaults(scene.settings());
      // Named or left out, sRGB is the default; and an empty development says nothing.
      for (v1::Settings* one : {&expected, &got}) {
        v1::Development& development = *one->mutable_development();
        if (development.space_case() == v1::Development::SPACE_NOT_SET)
          development.set_rgb_space(v1::SRGB);
      }
      EXPECT_EQ(got.DebugString(), expected.DebugString()) << own << "\n→ " << wanted;
    }
}

TEST(SettingsChange, OnlyWhatDiffersCountsAndSaysByWhom) {
  Look look;
  set_settings(settings_of("spp: 4 width: 10"), settings_of("spp: 9 width: 10"), "the form", look);
  ASSERT_EQ(look.mask.paths_size(), 1);
  EXPECT_EQ(look.mask.paths(0), "spp");
  EXPECT_EQ(replaced_by(look.replaced, "settings.spp"), "the form");
  set_settings(settings_of("spp: 4 width: 10"), settings_of("spp: 4 width: 10"), "the form", look);
  EXPECT_EQ(look.mask.paths_size(), 0);
  EXPECT_TRUE(look.replaced.empty());
}

}  // namespace
}  // namespace metamer::client
