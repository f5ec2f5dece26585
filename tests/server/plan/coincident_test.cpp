#include "server/plan/coincident.h"

#include <gtest/gtest.h>

#include "common/scene/settings.h"
#include "server/plan/plan.h"
#include "tests/server/test_scene.h"

namespace metamer {
namespace {

std::string told_of_two(const std::string& one, const std::string& other,
                        const std::string& material = "") {
  const std::string text =
      "camera { eye { z: 9 y: 1 } target {} } light { name: 'l' position { y: 9 } spectrum { "
      "standard: 'E' } } material { name: 'm' " +
      material + " } object { name: 'a' material: 'm' " + one +
      " } object { name: 'b' material: 'm' " + other + " } ";
  const v1::Plan plan = make_plan(
      test::compile_text(text), with_defaults(test::parse_scene(text).settings()), {.threads = 1});
  for (const v1::Notice& notice : plan.notice())
    if (notice.message().find("up to rounding") != std::string::npos)
      return notice.field() + ": " + notice.message();
  return {};
}

std::string flat_quad(double x, double y, const std::string& turn = "") {
  return "quad { corner { x: " + std::to_string(x) + " y: " + std::to_string(y) +
         " z: 1 } u { x: 1 } v { z: -1 } } " +
         (turn.empty() ? "" : "transform { rotate { axis { y: 1 } degrees: " + turn + " } }");
}

TEST(Coincident, QuadsThatOverlapInOnePlaneAreTold) {
  const std::string told =
      "object[1]: it lies in the plane of object[0] and covers part of it: which of them is seen "
      "is up to rounding";
  EXPECT_EQ(told_of_two(flat_quad(0, 0.3), flat_quad(0.5, 0.3)), told);
  EXPECT_EQ(told_of_two(flat_quad(0, 0.3), flat_quad(0, 0.3, "30")), told);
  EXPECT_EQ(told_of_two(flat_quad(0, 0), "plane {}"), told);
  EXPECT_EQ(told_of_two("plane {}", "plane { normal { y: -1 } }"), told);
  EXPECT_EQ(told_of_two(flat_quad(0, 0.3),
                        "quad { corner { x: 0.2 y: 0.3 z: 0.8 } u { z: -1 } v { x: 1 } }"),
            told)
      << "it faces the other way";
}

TEST(Coincident, WhatTouchesOrLiesApartIsNot) {
  EXPECT_EQ(told_of_two(flat_quad(0, 0.3), flat_quad(1, 0.3)), "") << "tiles side by side";
  EXPECT_EQ(told_of_two(flat_quad(0, 0.3), flat_quad(0, 0.301)), "");
  EXPECT_EQ(told_of_two(flat_quad(0, 0.3), flat_quad(2.5, 0.3, "45")), "");
  EXPECT_EQ(told_of_two(flat_quad(0, 0.3),
                        "quad { corner { x: 0.5 y: 0.3 z: 1 } u { y: 1 } v { z: -1 } }"),
            "")
      << "a wall on the floor";
  EXPECT_EQ(told_of_two(flat_quad(0, 0), "sphere { radius: 1 }"), "");
}

TEST(Coincident, ClearThingsArePassedTogether) {
  const std::string glass = "fresnel { dielectric { medium: 'N-BK7' } } transmission {}";
  EXPECT_EQ(told_of_two(flat_quad(0, 0.3), flat_quad(0.5, 0.3), glass), "");
}

}  // namespace
}  // namespace metamer
