// Lights whose lines lie between whole nanometres, through the whole of a method, against a plain
// sum over 0.005 nm.
#include <gtest/gtest.h>

#include <cmath>

#include "common/color/lab.h"
#include "common/color/xyz.h"
#include "common/spectral/cie.h"
#include "server/methods/direct_errors.h"
#include "server/plan/reference.h"
#include "tests/server/methods/lamps.h"
#include "tests/server/methods/methods.h"
#include "tests/server/test_scene.h"

namespace metamer::test {
namespace {

const Spectrum paint{{400, 440, 450, 500, 560, 590, 600, 640, 700},
                     {0.1, 0.3, 0.5, 0.7, 0.2, 0.35, 0.6, 0.1, 0.5}};

std::string scene_of(const Lamp& lamp) {
  return "camera { eye { z: 3 } target {} } light { name: 'l' position { y: 2 } spectrum { " +
         text_of(samples_of(lamp)) + " } } material { name: 'paint' mirror: 0.5 diffuse { " +
         text_of(paint) + " } specular { " + text_of(paint) +
         " } } object { name: 'o' material: 'paint' sphere { radius: 1 } }";
}

/// X Y Z of the paint seen over so many mirrors of itself, of luminance 1.
Xyz truth_of(const Spectrum& light, int mirrors) {
  std::vector<double> reflectance = PlainSum::reflectance(paint);
  for (double& value : reflectance) value = std::pow(value, 1 + mirrors);
  return PlainSum(light, cie::observer_1931())(reflectance);
}

TEST(NarrowLines, ExactAndTheReferenceAreThePlainSum) {
  for (const Lamp& lamp : lamps()) {
    const RenderScene scene = compile_text(scene_of(lamp));
    v1::Plan plan;
    *plan.mutable_method() = exact();
    plan.set_depth(1);
    const auto method = make_method(plan, scene);
    Reference reference(scene, cie::observer_1931());
    for (int mirrors = 0; mirrors <= 1; ++mirrors) {
      Gather gather(1);
      const std::uint32_t chain = mirrors == 0 ? 0 : gather.chain(0, {FactorKind::specular, 0, 1});
      gather.weights(gather.surface(chain, 0), 0) = {1, 0, 0};
      const auto own = resolve(*method, gather);
      const Xyz truth = truth_of(samples_of(lamp), mirrors),
                by_cells = reference.resolve(gather, 1);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double near = 1e-5 * (truth[1] + truth[axis]);
        EXPECT_NEAR(by_cells[axis], truth[axis], near) << lamp.name << " over " << mirrors;
        EXPECT_NEAR(own[axis], truth[axis], near) << lamp.name << " over " << mirrors;
      }
      const Xyz seen{own[0], own[1], own[2]};
      const Xyz white = usable_white(white_of(samples_of(lamp), cie::observer_1931()));
      EXPECT_LT(delta_e_00(to_lab(seen, white), to_lab(truth, white)), 0.002)
          << lamp.name << " over " << mirrors;
    }
  }
}

TEST(NarrowLines, ALaserWithoutZHasAWhiteToCompareBy) {
  const Lamp deep_red{"deep red", 0.05, 0, {{720, 0.1, 1}}};
  const Xyz white = Reference(compile_text(scene_of(deep_red)), cie::observer_1931()).white();
  EXPECT_EQ(white, (Xyz{1, 1, 1}));
}

TEST(NarrowLines, EveryMethodThatLearnsOfTheSceneGetsTheWhiteRight) {
  for (const Lamp& lamp : lamps()) {
    const RenderScene scene = compile_text(scene_of(lamp));
    const DirectColors truth(scene, cie::observer_1931());
    for (const v1::Method& choice : {exact(), prefilter(), fitted(8)}) {
      v1::Plan plan;
      *plan.mutable_method() = choice;
      const LightError error = truth.errors(*make_method(plan, scene)).front();
      EXPECT_LT(error.white, 0.01) << lamp.name << " by " << choice.ShortDebugString();
    }
  }
}

}  // namespace
}  // namespace metamer::test
