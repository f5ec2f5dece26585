// What a material may say of its model, the model's parts and its Fresnel term.

#include "common/scene/reflection.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/models/registry.h"
#include "common/scene/fresnel.h"
#include "scene_text.h"

namespace metamer::test {
namespace {

Strings of_material(const std::string& text) {
  return findings({.material = "material { name: \"grey\" " + text + " }\n"});
}

TEST(SceneReflection, EveryParametersEndsAreAllowedAndWhatLiesBeyondNamesTheNearest) {
  using models::Kind;
  for (const Kind kind : {Kind::model, Kind::diffuse, Kind::slope})
    for (const models::Entry& entry : models::registry(kind))
      for (const models::Parameter& one : entry.parameters) {
        const auto with = [&](double value) {
          const std::string part =
              std::string(entry.name) + " { " + one.name + ": " + number_text(value) + " }";
          return of_material(kind == Kind::slope ? "cook_torrance {} slope { " + part + " }"
                                                 : part);
        };
        EXPECT_EQ(with(one.min), Strings()) << entry.name << " " << one.name;
        EXPECT_EQ(with(one.max), Strings()) << entry.name << " " << one.name;
        for (const auto& [beyond, nearest] :
             {std::pair{one.min - 0.0625, one.min}, {one.max + 0.0625, one.max}})
          EXPECT_EQ(with(beyond),
                    Strings({"material[0]." + std::string(kind == Kind::slope ? "slope[0]." : "") +
                             entry.name + "." + one.name + ": " + one.name + " must lie in " +
                             number_text(one.min) + ".." + number_text(one.max) + " (it is " +
                             number_text(beyond) + "); the nearest allowed value is " +
                             number_text(nearest)}));
      }
}

TEST(SceneReflection, TheOpenEndsOfRangesAreErrors) {
  EXPECT_EQ(
      of_material("strauss { smoothness: 1 }"),
      Strings({"material[0].strauss.smoothness: smoothness must lie in 0..0.999997 (it is 1); "
               "the nearest allowed value is 0.999997"}));
  EXPECT_EQ(of_material("blinn {} slope { trowbridge_reitz { roughness: 0 } }"),
            Strings({"material[0].slope[0].trowbridge_reitz.roughness: roughness must lie in "
                     "0.001..1 (it is 0); the nearest allowed value is 0.001"}));
  EXPECT_EQ(
      of_material("blinn {} fresnel { dielectric { reflectance { constant: 1 } } }"),
      Strings({"material[0].fresnel.dielectric.reflectance.constant: a reflectance that gives n "
               "must lie in 0..0.999999 (it is 1)"}));
}

TEST(SceneReflection, WhatAModelHasNoUseForIsSaid) {
  EXPECT_EQ(of_material("blinn_phong {} slope { beckmann {} } attenuation: SMITH"),
            Strings({"material[0].slope: blinn_phong has no use for slope; models that have: "
                     "cook_torrance, blinn",
                     "material[0].attenuation: blinn_phong has no use for attenuation; models that "
                     "have: cook_torrance, blinn"}));
  EXPECT_EQ(of_material("strauss {} diffuseness: 0.5 specularness: 0.5").size(), 2u);
  EXPECT_EQ(of_material("fresnel { schlick {} }"),
            Strings({"material[0].fresnel: lambert has no use for fresnel without a mirror; models "
                     "that have: phong, "
                     "hall_greenberg, cook_torrance, blinn, he_torrance"}));
  EXPECT_EQ(of_material("mirror: 0.5 fresnel { schlick {} }"), Strings());
}

TEST(SceneReflection, SlopesAreFewNamedAndSumToOne) {
  EXPECT_EQ(
      of_material("blinn {} slope { weight: 0.5 ward {} } slope { weight: 0.6 beckmann {} }"),
      Strings({"material[0].slope: the weights of the slopes must sum to 1 (they sum to 1.1)"}));
  EXPECT_EQ(
      of_material("blinn {} slope { weight: 1 }"),
      Strings({"material[0].slope[0]: slope needs a distribution: gaussian, beckmann, schlick, "
               "trowbridge_reitz, ward"}));
  std::string five = "blinn {}";
  for (int i = 0; i < 5; ++i) five += " slope { weight: 0.2 beckmann {} }";
  EXPECT_EQ(of_material(five),
            Strings({"material[0].slope[4]: a material may have at most 4 slopes (it has 5)"}));
}

TEST(SceneReflection, FresnelTermsAreCheckedWhereTheyStand) {
  const auto fresnel = [](const std::string& text) {
    return of_material("blinn {} fresnel { " + text + " }");
  };
  EXPECT_EQ(fresnel(""),
            Strings({"material[0].fresnel: fresnel needs schlick, dielectric or conductor"}));
  EXPECT_EQ(
      fresnel("conductor { metal: \"Ay\" }"),
      Strings({"material[0].fresnel.conductor.metal: \"Ay\" is not a metal of the library (Ag, "
               "Al, Au, Cu); did you mean \"Ag\"?"}));
  EXPECT_EQ(fresnel("dielectric { medium: \"N-BK8\" }"),
            Strings({"material[0].fresnel.dielectric.medium: \"N-BK8\" is not a medium of the "
                     "library (N-BK7, N-SF11, diamond, water); did you mean \"N-BK7\"?"}));
  EXPECT_EQ(fresnel("conductor { n { constant: 1 } }"),
            Strings({"material[0].fresnel.conductor: conductor needs a metal, or n and k"}));
  EXPECT_EQ(
      fresnel("conductor { metal: \"Au\" k { constant: 1 } }"),
      Strings({"material[0].fresnel.conductor: conductor takes either a metal or n and k, not "
               "both"}));
  EXPECT_EQ(fresnel("dielectric {}"),
            Strings({"material[0].fresnel.dielectric: dielectric needs a medium, n, reflectance, "
                     "sellmeier or cauchy"}));
  EXPECT_EQ(
      fresnel("dielectric { n { constant: 0 } }"),
      Strings({"material[0].fresnel.dielectric.n.constant: an index of refraction must lie in "
               "0.01..100 (it is 0)"}));
  EXPECT_EQ(
      fresnel("dielectric { sellmeier { b: 1 b: 2 c: 1 } }"),
      Strings({"material[0].fresnel.dielectric.sellmeier: sellmeier needs as many b as c (2 b, "
               "1 c)"}));
  // A pole of the formula among the visible wavelengths.
  EXPECT_EQ(fresnel("dielectric { sellmeier { b: 1 c: 0.25 } }").size(), 1u);
  EXPECT_EQ(
      fresnel("dielectric { cauchy { a: -1 } }"),
      Strings({"material[0].fresnel.dielectric.cauchy: n must lie in 0.01..100 (it is -1 at 360 "
               "nm)"}));
}

TEST(SceneReflection, AttenuationHasTheRoughnessOfTheSlopes) {
  v1::Material material;
  material.mutable_cook_torrance();
  v1::Slope& first = *material.add_slope();
  first.set_weight(0.25);
  first.mutable_beckmann()->set_roughness(0.2);
  v1::Slope& second = *material.add_slope();
  second.set_weight(0.75);
  second.mutable_ward()->set_roughness_u(0.1);
  second.mutable_ward()->set_roughness_v(0.3);
  const auto reflection = reflection_of(material);
  EXPECT_EQ(reflection.slope_count, 2u);
  EXPECT_DOUBLE_EQ(reflection.roughness, std::sqrt(0.25 * 0.04 + 0.75 * (0.01 + 0.09) / 2));
}

const AssetReader no_files = [](const std::string&) -> Result<std::string> { return problem(""); };

TEST(Fresnel, AReflectanceAtNormalIncidenceGivesItsIndex) {
  v1::Fresnel fresnel;
  v1::Samples& samples = *fresnel.mutable_dielectric()->mutable_reflectance()->mutable_samples();
  samples.add_wavelength(400);
  samples.add_wavelength(700.5);
  samples.add_value(0.04);
  samples.add_value(0.25);
  const auto constants = load_fresnel(fresnel, "fresnel", no_files);
  ASSERT_TRUE(constants);
  EXPECT_TRUE(constants->k.nm.empty());
  EXPECT_NEAR(constants->n.values.front(), 1.5, 1e-12);  // (1 + 0.2)/(1 − 0.2)
  EXPECT_NEAR(constants->n.values.back(), 3, 1e-12);     // (1 + 0.5)/(1 − 0.5)
  EXPECT_EQ(constants->n.nm.back(), 700.5);
  EXPECT_EQ(constants->n.nm.size(), 302u);
}

}  // namespace
}  // namespace metamer::test
