// A method's tables for a GPU, summed as their header says, against the method's own way.

#include <gtest/gtest.h>

#include "server/transport/factor_rows.h"
#include "tests/server/methods/methods.h"
#include "tests/server/test_scene.h"

#include "common/scene/settings.h"
#include "server/plan/plan.h"

namespace metamer {
namespace {

const char* const lit_paint = R"(
  camera { eye { z: 3 } target {} }
  light { name: "a" position { y: 2 } spectrum { standard: "F11" } luminance: 0.8 }
  light { name: "b" position { y: 1 } spectrum { standard: "A" } luminance: 0.3 }
  material {
    name: "paint"
    diffuse { samples { wavelength: [400, 500, 600, 700] value: [0.1, 0.7, 0.2, 0.5] } }
    specular { samples { wavelength: [400, 700] value: [0.9, 0.3] } }
    diffuseness: 0.6 specularness: 0.4 blinn_phong {}
  }
  material {
    name: "gold" diffuseness: 0 specularness: 1 cook_torrance {} slope { beckmann {} }
    fresnel { conductor { metal: "Au" } }
  }
  object { name: "o" material: "paint" sphere { radius: 1 } }
  object { name: "p" material: "gold" sphere { center { x: 3 } radius: 1 } }
)";

/// X Y Z of a row's part of a light, weight 1.
std::array<float, 3> color(const DirectTables& tables, std::uint32_t light, std::uint32_t row) {
  std::array<float, 3> xyz{};
  const float* value =
      &tables.values[4 * (std::size_t{row} * tables.row_stride + light * tables.light_stride)];
  const float* sensor = &tables.sensors[4 * std::size_t{light} * tables.sensor_stride];
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t i = 0; i < 4 * std::size_t{tables.size}; ++i)
      xyz[axis] += sensor[axis * 4 * tables.size + i] * value[i];
  return xyz;
}

TEST(DirectTables, GiveWhatEveryMethodResolves) {
  const RenderScene scene = test::compile_text(lit_paint);
  const FactorRows rows(scene);
  for (const v1::Method& method : test::all_methods()) {
    SCOPED_TRACE(method.ShortDebugString());
    v1::Settings settings;
    *settings.mutable_method() = method;
    const v1::Plan plan = make_plan(scene, with_defaults(settings), {.threads = 1});
    const auto made = make_method(plan, scene);
    const DirectTables tables = made->direct_tables();

    // A pixel that sees both lights on the paint, and one in the gold.
    Gather gather(2);
    const auto paint = gather.surface(0, 0);
    gather.weights(paint, 0) = {0.5f, 0.25f, 0.125f};
    gather.weights(paint, 1) = {0.25f, 0, 0};
    gather.add(0, 1, {FactorKind::fresnel, 1, 200}, 0.75f);
    std::array<float, 3> expected{};
    const auto add = [&](float weight, std::uint32_t light, std::uint32_t row) {
      const std::array<float, 3> one = color(tables, light, row);
      for (std::size_t axis = 0; axis < 3; ++axis) expected[axis] += weight * one[axis];
    };
    add(0.5f, 0, rows.diffuse(0));
    add(0.25f, 0, rows.specular(0));
    add(0.125f, 0, FactorRows::white);
    add(0.25f, 1, rows.diffuse(0));
    add(0.75f, 1, rows.row({FactorKind::fresnel, 1, 200}));

    const std::array<float, 3> resolved = test::resolve(*made, gather);
    EXPECT_GT(resolved[1], 0);
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(resolved[axis], expected[axis], 2e-6f * (1 + resolved[axis])) << axis;
  }
}

}  // namespace
}  // namespace metamer
