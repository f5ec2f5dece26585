// What `metamer relight` lights each picture by, and how it calls that.
#include <gtest/gtest.h>

#include "client/cli/commands/relight/file_names.h"
#include "client/cli/commands/relight/variants.h"

namespace metamer::cli {
namespace {

using Words = std::vector<std::string>;

const Words left_and_right = {"left", "right", "*"};

std::optional<std::vector<Variant>> light_variants(const Words& words, const Words& names) {
  Report report(true);
  return variants_of("--light", "light", words, names, report);
}

Words labels(const Words& words) {
  Words all;
  const auto variants = light_variants(words, left_and_right);
  for (const Variant& one : *variants) all.push_back(one.label);
  return all;
}

/// Where each light of left and right has its power, in nm: lines tell lights apart.
std::vector<double> lit_at(const Words& words, std::size_t picture = 0) {
  client::Factors factors;
  for (const char* name : {"left", "right"}) {
    auto& light = *factors.scene.add_light();
    light.set_name(name);
    light.mutable_power()->add_nm(400);
    light.mutable_power()->add_values(1);
  }
  Report report(true);
  Swapper swapper(factors, report);
  v1::SceneFactors scene = factors.scene;
  EXPECT_TRUE(swapper.swap_lights(light_variants(words, left_and_right)->at(picture), scene));
  std::vector<double> nm;
  for (const auto& light : scene.light())
    nm.push_back(light.power().nm(light.power().nm_size() / 2));
  return nm;
}

TEST(RelightVariants, NoPictureIsLabelledByALightThatItDoesNotHave) {
  EXPECT_FALSE(light_variants({"*=D65", "*=A", "Bulb=F11"}, {"Bulb", "*"}));
  EXPECT_FALSE(light_variants({"left=F11", "*=D65", "*=A"}, left_and_right));
  EXPECT_FALSE(light_variants({"*=D65", "left=A", "right=F11"}, left_and_right));
  EXPECT_TRUE(light_variants({"*=D65", "*=A"}, {"Bulb", "*"}));
}

TEST(RelightVariants, TheLabelNamesAllThatLights) {
  EXPECT_EQ(labels({"*=D65", "*=A", "left=F11"}), Words({"D65, left=F11", "A, left=F11"}));
  EXPECT_EQ(labels({"*=D65", "left=A", "left=F11"}), Words({"D65, left=A", "D65, left=F11"}));
  EXPECT_EQ(labels({"*=D65", "*=kept", "left=kept", "left=F11"}),
            Words({"D65, left=kept", "kept, left=F11"}));
  EXPECT_EQ(labels({"left=D65", "left=A", "right=F11"}), Words({"D65", "A"}));
  EXPECT_EQ(
      file_name("z-{light}.png", light_variants({"*=A", "left=F11"}, left_and_right)->front(), {}),
      "z-A--left-F11.png");
}

TEST(RelightVariants, ALightGoesByTheLastNameThatMeansIt) {
  EXPECT_EQ(lit_at({"*=600nm", "left=500nm"}), (std::vector<double>{500, 600}));
  EXPECT_EQ(lit_at({"*=600nm", "left=500nm", "left=550nm"}, 1), (std::vector<double>{550, 600}));
  EXPECT_EQ(lit_at({"*=600nm", "left=kept"}), (std::vector<double>{400, 600}));
  EXPECT_EQ(lit_at({"right=500nm"}), (std::vector<double>{400, 500}));
}

}  // namespace
}  // namespace metamer::cli
