// Lights whose lines lie between whole nanometres, through the whole of a method, against a plain
// sum over 0.005 nm.
#include <gtest/gtest.h>

#include <cmath>

#include "common/color/lab.h"
#include "common/color/xyz.h"
#include "common/spectral/cie.h"
#include "server/methods/direct_errors.h"
#include "server/plan/reference.h"
#include "tests/server/methods/methods.h"
#include "tests/server/test_scene.h"

namespace metamer::test {
namespace {

struct GaussianLine {
  double nm, width, power;  ///< width: σ.
};

struct Lamp {
  const char* name;
  double step;  ///< nm, of its data; 0: uneven, finer near the lines.
  double continuum;
  std::vector<GaussianLine> lines;
};

const std::vector<Lamp> lamps = {
    {"laser phosphor", 0.1, 0.3, {{445.5, 0.13, 20}, {560, 50, 60}}},
    {"mercury",
     0.05,
     0,
     {{404.66, 0.085, 6},
      {435.83, 0.085, 20},
      {546.07, 0.085, 30},
      {576.96, 0.085, 5},
      {579.07, 0.085, 5}}},
    {"metal halide",
     0.2,
     0.05,
     {{435.83, 0.17, 8},
      {535.05, 0.17, 25},
      {588.99, 0.17, 15},
      {589.59, 0.17, 15},
      {671, 0.3, 3}}},
    {"three lasers", 0.05, 0, {{450.3, 0.05, 10}, {532.1, 0.05, 12}, {638.4, 0.05, 14}}},
    {"helium-neon", 0.02, 0, {{632.8, 0.04, 1}}},
    {"sodium", 0.0, 0, {{588.995, 0.02, 2}, {589.592, 0.02, 1}}},
    {"led", 5, 0, {{455, 11, 1}, {570, 55, 3}}},
};

double power_at(const Lamp& lamp, double nm) {
  double sum = lamp.continuum;
  for (const GaussianLine& line : lamp.lines)
    sum += line.power / line.width * std::exp(-0.5 * std::pow((nm - line.nm) / line.width, 2));
  return sum;
}

/// What an instrument would have written.
Spectrum samples_of(const Lamp& lamp) {
  Spectrum spectrum;
  const auto add = [&](double nm) {
    spectrum.nm.push_back(nm);
    spectrum.values.push_back(power_at(lamp, nm));
  };
  if (lamp.step > 0) {
    const int count = static_cast<int>(std::min(470 / lamp.step, 4000.0));
    const double from = lamp.lines.front().nm - 40;
    for (int i = 0; i <= count; ++i) add(std::round((from + i * lamp.step) * 1e4) / 1e4);
    return spectrum;
  }
  for (double nm = 500; nm < 588.8; nm += 7.3) add(nm);
  for (int i = 0; i <= 200; ++i) add(588.8 + 0.005 * i);
  for (double nm = 590; nm < 700; nm += 7.3) add(nm);
  return spectrum;
}

std::string text(const Spectrum& spectrum) {
  std::string nm, values;
  char number[40];
  for (std::size_t i = 0; i < spectrum.nm.size(); ++i) {
    std::snprintf(number, sizeof number, "%s%.10g", i ? ", " : "", spectrum.nm[i]);
    nm += number;
    std::snprintf(number, sizeof number, "%s%.10g", i ? ", " : "", spectrum.values[i]);
    values += number;
  }
  return "samples { wavelength: [" + nm + "] value: [" + values + "] }";
}

const Spectrum paint{{400, 440, 450, 500, 560, 590, 600, 640, 700},
                     {0.1, 0.3, 0.5, 0.7, 0.2, 0.35, 0.6, 0.1, 0.5}};

std::string scene_of(const Lamp& lamp) {
  return "camera { eye { z: 3 } target {} } light { name: 'l' position { y: 2 } spectrum { " +
         text(samples_of(lamp)) + " } } material { name: 'paint' mirror: 0.5 diffuse { " +
         text(paint) + " } specular { " + text(paint) +
         " } } object { name: 'o' material: 'paint' sphere { radius: 1 } }";
}

/// X Y Z of the paint seen over so many mirrors of itself, of luminance 1, as a plain sum.
Xyz plain_sum(const Spectrum& light, int mirrors) {
  constexpr double step = 0.005;
  std::vector<double> nm(94000);
  for (std::size_t i = 0; i < nm.size(); ++i) nm[i] = 360 + step * (static_cast<double>(i) + 0.5);
  const auto power = resample(light, nm, Outside::zero).values;
  const auto surface = resample(paint, nm, Outside::hold).values;
  Xyz xyz{};
  double luminance = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto seen =
        resample(cie::matching_functions(cie::Observer::cie_1931_2deg)[axis], nm, Outside::zero)
            .values;
    for (std::size_t i = 0; i < nm.size(); ++i) {
      xyz[axis] += power[i] * seen[i] * std::pow(surface[i], 1 + mirrors);
      if (axis == 1) luminance += power[i] * seen[i];
    }
  }
  for (double& value : xyz) value /= luminance;
  return xyz;
}

TEST(NarrowLines, ExactAndTheReferenceAreThePlainSum) {
  for (const Lamp& lamp : lamps) {
    const RenderScene scene = compile_text(scene_of(lamp));
    v1::Plan plan;
    *plan.mutable_method() = exact();
    plan.set_depth(1);
    const auto method = make_method(plan, scene);
    Reference reference(scene, cie::Observer::cie_1931_2deg);
    for (int mirrors = 0; mirrors <= 1; ++mirrors) {
      Gather gather(1);
      const std::uint32_t chain = mirrors == 0 ? 0 : gather.chain(0, {FactorKind::specular, 0, 1});
      gather.weights(gather.surface(chain, 0), 0) = {1, 0, 0};
      const auto own = resolve(*method, gather);
      const Xyz truth = plain_sum(samples_of(lamp), mirrors),
                by_cells = reference.resolve(gather, 1);
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double near = 1e-5 * (truth[1] + truth[axis]);
        EXPECT_NEAR(by_cells[axis], truth[axis], near) << lamp.name << " over " << mirrors;
        if (mirrors > 0) continue;
        EXPECT_NEAR(own[axis], truth[axis], near) << lamp.name;
      }
      // Over a mirror, exact takes a product of two slopes within a nanometre for a line: 7e-4 of a
      // laser at most, with these steep paints.
      const Xyz seen{own[0], own[1], own[2]};
      const Xyz white = usable_white(white_of(samples_of(lamp), cie::Observer::cie_1931_2deg));
      EXPECT_LT(delta_e_00(to_lab(seen, white), to_lab(truth, white)), mirrors == 0 ? 0.002 : 0.05)
          << lamp.name << " over " << mirrors;
    }
  }
}

TEST(NarrowLines, ALaserWithoutZHasAWhiteToCompareBy) {
  const Lamp deep_red{"deep red", 0.05, 0, {{720, 0.1, 1}}};
  const Xyz white =
      Reference(compile_text(scene_of(deep_red)), cie::Observer::cie_1931_2deg).white();
  EXPECT_EQ(white, (Xyz{1, 1, 1}));
}

TEST(NarrowLines, EveryMethodThatLearnsOfTheSceneGetsTheWhiteRight) {
  for (const Lamp& lamp : lamps) {
    const RenderScene scene = compile_text(scene_of(lamp));
    const DirectColors truth(scene, cie::Observer::cie_1931_2deg);
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
