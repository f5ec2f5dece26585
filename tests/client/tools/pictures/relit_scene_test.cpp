// A kept picture follows a scene's look, and nothing else.
#include "client/tools/pictures/relit_scene.h"

#include <google/protobuf/text_format.h>
#include <gtest/gtest.h>

#include "common/spectral/cie.h"

namespace metamer::client {
namespace {

v1::Scene kept_scene() {
  v1::Scene scene;
  EXPECT_TRUE(google::protobuf::TextFormat::ParseFromString(
      R"(camera { eye { z: 4 } }
      light { name: "key" position { z: 4 } spectrum { standard: "D65" } luminance: 0.5 }
      light { name: "fill" position { x: 4 } spectrum { standard: "A" } }
      material { name: "m" diffuse { constant: 0.5 } diffuseness: 1 } material { name: "n" }
      object { name: "o" material: "m" sphere { radius: 1 } } settings { width: 8 height: 8 })",
      &scene));
  return scene;
}

Factors kept_factors() {
  Factors factors;
  for (const char* name : {"key", "fill"}) {
    auto& light = *factors.scene.add_light();
    light.set_name(name);
    light.set_luminance(1);
    light.mutable_power()->add_nm(500);
    light.mutable_power()->add_values(1);
  }
  for (const char* name : {"m", "n"}) factors.scene.add_material()->set_name(name);
  return factors;
}

Result<std::string> no_files(const std::string& name) { return problem("no file " + name); }

Result<RelitScene> relit_to(const std::function<void(v1::Scene&)>& change) {
  v1::Scene wanted = kept_scene();
  change(wanted);
  return relit_scene(kept_factors(), kept_scene(), wanted, no_files);
}

TEST(RelitScene, WhatIsTheSameStaysAsItWasRendered) {
  const auto relit = relit_to([](v1::Scene&) {});
  ASSERT_TRUE(relit);
  EXPECT_EQ(relit->scene.DebugString(), kept_factors().scene.DebugString());
}

TEST(RelitScene, ALightGetsItsPowerAndItsLuminance) {
  const auto relit = relit_to([](v1::Scene& scene) {
    scene.mutable_light(1)->mutable_spectrum()->set_standard("F11");
    scene.mutable_light(1)->set_luminance(0.25);
  });
  ASSERT_TRUE(relit);
  const auto& power = relit->scene.light(1).power();
  const Spectrum& f11 = *cie::illuminant("F11");
  EXPECT_EQ(std::vector<double>(power.nm().begin(), power.nm().end()), f11.nm);
  EXPECT_EQ(std::vector<double>(power.values().begin(), power.values().end()), f11.values);
  EXPECT_EQ(relit->scene.light(1).luminance(), 0.25);
  EXPECT_EQ(relit->scene.light(0).DebugString(), kept_factors().scene.light(0).DebugString());
}

TEST(RelitScene, PaintObserverAndDevelopmentAreTheWantedOnes) {
  const auto relit = relit_to([](v1::Scene& scene) {
    scene.mutable_material(1)->mutable_specular()->set_constant(0.25);
    scene.mutable_settings()->set_observer(v1::CIE_1964_10DEG);
    scene.mutable_settings()->mutable_development()->set_adaptation(v1::BRADFORD);
  });
  ASSERT_TRUE(relit);
  EXPECT_EQ(relit->scene.material(1).specular().values(0), 0.25);
  EXPECT_FALSE(relit->scene.material(1).has_diffuse());
  EXPECT_EQ(relit->plan.observer(), v1::CIE_1964_10DEG);
  EXPECT_EQ(relit->plan.development().adaptation(), v1::BRADFORD);
  EXPECT_TRUE(relit->plan.method().has_exact());
}

TEST(RelitScene, WhatRaysWouldMeetCantBeChanged) {
  const std::function<void(v1::Scene&)> changes[] = {
      [](v1::Scene& scene) { scene.mutable_camera()->mutable_eye()->set_z(5); },
      [](v1::Scene& scene) { scene.mutable_light(0)->mutable_position()->set_x(1); },
      [](v1::Scene& scene) { scene.add_light()->set_name("more"); },
      [](v1::Scene& scene) { scene.mutable_light()->RemoveLast(); },
      [](v1::Scene& scene) { scene.mutable_material(0)->set_diffuseness(0.5); },
      [](v1::Scene& scene) { scene.mutable_object(0)->set_material("n"); }};
  for (const auto& change : changes) {
    const auto relit = relit_to(change);
    ASSERT_FALSE(relit);
    EXPECT_FALSE(relit.error().message.empty());
  }
}

TEST(RelitScene, OtherSettingsDoNotCount) {
  const auto relit = relit_to([](v1::Scene& scene) {
    scene.mutable_settings()->set_width(640);
    scene.mutable_settings()->set_backend(v1::GL);
    scene.mutable_settings()->mutable_method()->mutable_rgb();
  });
  ASSERT_TRUE(relit);
  EXPECT_TRUE(same_look(kept_scene(), kept_scene()));
}

TEST(RelitScene, AFileThatCantBeReadIsNamedAtItsPlace) {
  const auto relit = relit_to(
      [](v1::Scene& scene) { scene.mutable_light(0)->mutable_spectrum()->set_file("lamp.txt"); });
  ASSERT_FALSE(relit);
  EXPECT_EQ(relit.error().field, "light[0].spectrum.file");
}

TEST(RelitScene, FactorsOfAnotherSceneAreRefused) {
  v1::Scene scene = kept_scene();
  Factors factors = kept_factors();
  factors.scene.mutable_material()->RemoveLast();
  EXPECT_FALSE(relit_scene(factors, scene, scene, no_files));
}

TEST(RelitScene, LooksAreTheSameWhereWhatItChangesIs) {
  v1::Scene other = kept_scene();
  other.mutable_settings()->set_spp(99);
  EXPECT_TRUE(same_look(kept_scene(), other));
  other.mutable_light(0)->set_luminance(0.1);
  EXPECT_FALSE(same_look(kept_scene(), other));
}

}  // namespace
}  // namespace metamer::client
