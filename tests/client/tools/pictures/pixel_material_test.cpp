#include "client/tools/pictures/pixel_material.h"

#include <google/protobuf/text_format.h>
#include <gtest/gtest.h>

namespace metamer::client {
namespace {

/// Three pixels: nothing; a wall in a highlight; a mirror that shows a lamp by a door.
Factors kept_pixels() {
  Factors factors;
  EXPECT_TRUE(google::protobuf::TextFormat::ParseFromString(
      R"(material { name: "door" } material { name: "wall" } material { name: "mirror" })",
      &factors.scene));
  // Product 1: the mirror; product 2: the mirror, then the door.
  EXPECT_TRUE(google::protobuf::TextFormat::ParseFromString(
      R"(product_parent: [0, 1] product_material: [2, 0] product_node: [0, 0]
      product_term: [FACTOR_SPECULAR, FACTOR_SPECULAR]
      signature_product: [0, 0, 2, 0] signature_light: [0, 0, 0, 0]
      signature_material: [1, 0, 1, 0] signature_node: [0, 0, 0, 0]
      signature_term: [FACTOR_DIFFUSE, FACTOR_WHITE, FACTOR_DIFFUSE, FACTOR_DIFFUSE])",
      &factors.tables));
  factors.width = 3;
  factors.height = 1;
  factors.end = {0, 2, 4};
  factors.signature = {0, 1, 2, 3};
  factors.weight = {0.1F, 5, 0.3F, 0.2F};
  return factors;
}

TEST(PixelMaterial, IsThatOfTheFirstSurfaceFromTheEye) {
  Factors factors = kept_pixels();
  EXPECT_EQ(pixel_material(factors, 0, 0), std::nullopt) << "no light comes from there";
  EXPECT_EQ(pixel_material(factors, 1, 0), "wall") << "white is no material's";
  EXPECT_EQ(pixel_material(factors, 2, 0), "mirror") << "not what it shows";
  factors.weight[3] = 0.4F;
  EXPECT_EQ(pixel_material(factors, 2, 0), "door") << "the one with the most weight";
}

TEST(PixelMaterial, NamesTheObjectsThatHaveIt) {
  v1::Scene scene;
  ASSERT_TRUE(google::protobuf::TextFormat::ParseFromString(
      R"(object { name: "a" material: "m" } object { material: "n" } object { material: "m" })",
      &scene));
  EXPECT_EQ(objects_of(scene, "m"), (std::vector<std::string>{"a", "object[2]"}));
  EXPECT_EQ(objects_of(scene, "n"), (std::vector<std::string>{"object[1]"}));
  EXPECT_TRUE(objects_of(scene, "x").empty());
}

}  // namespace
}  // namespace metamer::client
