// What a fluorescent patch sends out, by each method, against a plain sum over 0.25 nm of E[3.2-1].
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "common/color/lab.h"
#include "common/color/xyz.h"
#include "server/plan/plan.h"
#include "server/plan/reference.h"
#include "server/transport/factor_rows.h"
#include "tests/server/methods/methods.h"
#include "tests/server/test_scene.h"

namespace metamer::test {
namespace {

double bell_at(double nm, double middle, double deviation) {
  return std::exp(-std::pow((nm - middle) / deviation, 2) / 2);
}

// Made up, about as a stilbene that brightens paper: they overlap from 390 to 430 nm.
double absorbed_at(double nm) { return nm >= 300 && nm <= 430 ? 0.4 * bell_at(nm, 370, 25) : 0; }
double emitted_at(double nm) { return nm >= 390 && nm <= 560 ? bell_at(nm, 440, 22) : 0; }
double paper_at(double nm) { return nm < 400 ? 0.4 : nm < 430 ? 0.4 + (nm - 400) / 75 : 0.8; }
constexpr double patch_yield = 0.9;

std::string samples_text(double (*function)(double), double from, double to) {
  std::string at, values;
  for (double nm = from; nm <= to; nm += 0.5) {
    at += std::to_string(nm) + ",";
    values += std::to_string(function(nm)) + ",";
  }
  at.pop_back();
  values.pop_back();
  return "samples { wavelength: [" + at + "] value: [" + values + "] } interpolation: LINEAR";
}

double uv_lamp(double nm) { return nm >= 340 && nm <= 480 ? bell_at(nm, 368, 9) + 2e-4 : 0; }

/// A lamp with what it is to the plain sum: power at a wavelength, or a line of power 1 at `line`.
struct PatchLamp {
  std::string name, text;
  double luminance;
  std::function<double(double)> power;
  double line = 0;
};

std::function<double(double)> illuminant_at(const char* illuminant) {
  return [illuminant](double nm) {
    return resample(*cie::illuminant(illuminant), {nm}, Outside::zero).values[0];
  };
}

std::vector<PatchLamp> lamps_of_patches() {
  return {{"D65", "standard: 'D65'", 1, illuminant_at("D65")},
          {"A", "standard: 'A'", 1, illuminant_at("A")},
          {"UV lamp", samples_text(uv_lamp, 340, 480), 0.02, uv_lamp},
          {"laser", "line { nm: 365 power: 1 }", 1e-4, {}, 365}};
}

std::string material_text(double quantum_yield) {
  return "diffuse { " + samples_text(paper_at, 380, 450) + " } fluorescence { excitation { " +
         samples_text(absorbed_at, 300, 430) + " } emission { " +
         samples_text(emitted_at, 390, 560) + " } quantum_yield: " + std::to_string(quantum_yield) +
         " }";
}

std::string patch_scene(const std::string& spectrum, double luminance,
                        const std::string& material) {
  return "camera { eye { z: 3 } target {} } light { name: 'l' direction { z: -1 } spectrum { " +
         spectrum + " } luminance: " + std::to_string(luminance) + " } material { name: 'paper' " +
         material +
         " } object { name: 'o' material: 'paper' quad { corner { x: -9 y: -9 } u { x: 18 } v { y: "
         "18 } } }";
}

/// E[3.2-1] and E[3.1-8] as they stand, at the middles of cells of 0.25 nm.
Xyz plain_sum(const PatchLamp& lamp, double quantum_yield) {
  constexpr double step = 0.25;
  std::vector<double> nm;
  for (double at = 300 + step / 2; at < 830; at += step) nm.push_back(at);
  std::array<std::vector<double>, 3> observer;
  for (std::size_t axis = 0; axis < 3; ++axis)
    observer[axis] = resample(cie::observer_1931().functions()[axis], nm, Outside::zero).values;
  double photons = 0, y = 0, absorbed_so_far = 0;
  for (const double at : nm) photons += emitted_at(at) * at * step;
  Xyz xyz{};
  const auto add = [&](const std::array<double, 3>& seen, double light, double out) {
    for (std::size_t axis = 0; axis < 3; ++axis) xyz[axis] += seen[axis] * out;
    y += seen[1] * light;
  };
  if (lamp.line > 0) {
    std::array<double, 3> seen{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      seen[axis] =
          resample(cie::observer_1931().functions()[axis], {lamp.line}, Outside::zero).values[0];
    add(seen, 1, paper_at(lamp.line));
  }
  for (std::size_t i = 0; i < nm.size(); ++i) {
    if (lamp.line > 0 && nm[i] - step < lamp.line && lamp.line < nm[i])
      absorbed_so_far = absorbed_at(lamp.line) * lamp.line;
    const double light = lamp.line > 0 ? 0 : lamp.power(nm[i]);
    const double own = absorbed_at(nm[i]) * nm[i] * light * step;
    const double out = paper_at(nm[i]) * light +
                       quantum_yield * emitted_at(nm[i]) * (absorbed_so_far + own / 2) / photons;
    absorbed_so_far += own;
    add({observer[0][i], observer[1][i], observer[2][i]}, light * step, out * step);
  }
  for (double& value : xyz) value *= lamp.luminance / y;
  return xyz;
}

Gather patch_of(const RenderScene& scene, float weight = 1) {
  Gather gather = gather_for(scene);
  gather.weights(gather.surface(0, 0), 0).diffuse = weight;
  return gather;
}

std::unique_ptr<Method> patch_method(const v1::Method& choice, const RenderScene& scene) {
  v1::Settings settings;
  *settings.mutable_method() = choice;
  return make_method(make_plan(scene, settings, {.threads = 1}), scene);
}

Xyz patch_seen_by(const v1::Method& choice, const RenderScene& scene) {
  const auto xyz = resolve(*patch_method(choice, scene), patch_of(scene));
  return {xyz[0], xyz[1], xyz[2]};
}

double patch_difference(const Xyz& one, const Xyz& other) {
  const Xyz white{1, 1, 1};
  return delta_e_00(to_lab(one, white), to_lab(other, white));
}

TEST(Fluorescence, OfAPatchIsThePlainSumByEachMethod) {
  struct Accuracy {
    v1::Method method;
    double smooth, narrow;  // ΔE00
  };
  // What each is off on the lamps themselves; three numbers are none for a lamp in the ultraviolet.
  const std::vector<Accuracy> methods = {{exact(), 0.01, 0.01},
                                         {uniform(360, 830, 1), 0.02, 0.05},
                                         {uniform(380, 780, 5), 0.1, 0.3},
                                         {cells(380, 780, 10), 0.3, 0.5},
                                         {linear(8, v1::Linear::OBSERVER), 0.3, 0.3},
                                         {fitted(8), 0.3, 0.3},
                                         {prefilter(), 0.02, 0.02}};
  for (const PatchLamp& lamp : lamps_of_patches()) {
    const RenderScene scene =
        compile_text(patch_scene(lamp.text, lamp.luminance, material_text(patch_yield)));
    const Xyz truth = plain_sum(lamp, patch_yield), without = plain_sum(lamp, 0);
    EXPECT_GT(patch_difference(truth, without), 0.5) << lamp.name << " shows nothing";
    const bool narrow = lamp.name == "laser" || lamp.name == "UV lamp";
    const Xyz reference =
        metamer::Reference(scene, cie::observer_1931()).resolve(patch_of(scene), 1);
    for (std::size_t axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(reference[axis], truth[axis], 2e-4 * (truth[1] + truth[axis])) << lamp.name;
    for (const Accuracy& one : methods)
      EXPECT_LT(patch_difference(patch_seen_by(one.method, scene), truth),
                narrow ? one.narrow : one.smooth)
          << lamp.name << " by " << one.method.ShortDebugString();
    EXPECT_LT(patch_difference(patch_seen_by(exact(), scene), reference), 1e-3) << lamp.name;
  }
}

TEST(Fluorescence, OfNoYieldIsAsIfItWereNotThere) {
  for (const PatchLamp& lamp : lamps_of_patches()) {
    const RenderScene none = compile_text(patch_scene(lamp.text, lamp.luminance, material_text(0)));
    const RenderScene without = compile_text(patch_scene(
        lamp.text, lamp.luminance, "diffuse { " + samples_text(paper_at, 380, 450) + " }"));
    for (const v1::Method& choice :
         {exact(), uniform(380, 780, 5), prefilter(), rgb(), fitted(8)}) {
      const Xyz one = patch_seen_by(choice, none), other = patch_seen_by(choice, without);
      for (std::size_t axis = 0; axis < 3; ++axis)
        EXPECT_NEAR(one[axis], other[axis], 1e-6) << lamp.name << choice.ShortDebugString();
    }
  }
}

TEST(Fluorescence, MakesPaperBrighterAndBluerUnderDaylightThanUnderABulb) {
  const auto gain = [](const char* light, double& bluer) {
    const std::string spectrum = std::string("standard: '") + light + "'";
    const Xyz white = white_of(*cie::illuminant(light), cie::observer_1931());
    const Lab bright = to_lab(
        patch_seen_by(exact(), compile_text(patch_scene(spectrum, 1, material_text(patch_yield)))),
        white);
    const Lab plain = to_lab(
        patch_seen_by(exact(), compile_text(patch_scene(spectrum, 1, material_text(0)))), white);
    bluer = plain.b - bright.b;
    return bright.l - plain.l;
  };
  double by_day, by_bulb;
  const double brighter_by_day = gain("D65", by_day), brighter_by_bulb = gain("A", by_bulb);
  EXPECT_GT(by_day, 5);
  EXPECT_GT(by_day, 1.5 * by_bulb);  // whose white has little blue
  EXPECT_GT(by_bulb, 0);
  EXPECT_GT(brighter_by_day, 2 * brighter_by_bulb);
}

TEST(Fluorescence, GoesOverMirrorsAsALightOfItsOwn) {
  const std::string mirror =
      "material { name: 'mirror' mirror: 1 fresnel { conductor { metal: 'Au' } } }"
      "object { name: 'm' material: 'mirror' sphere { center { x: 30 } radius: 1 } }";
  const RenderScene scene =
      compile_text(patch_scene("standard: 'D65'", 1, material_text(patch_yield)) + mirror);
  Gather gather = gather_for(scene);
  const std::uint32_t chain = gather.chain(0, {FactorKind::fresnel, 1, 0.7f});
  gather.weights(gather.surface(chain, 0), 0) = {0.8f, 0.1f, 0.05f};
  gather.weights(gather.surface(0, 0), 0).diffuse = 0.2f;
  const Xyz reference = metamer::Reference(scene, cie::observer_1931()).resolve(gather, 1);
  for (const v1::Method& choice :
       {exact(), uniform(360, 830, 1), linear(12, v1::Linear::OBSERVER), fitted(12)}) {
    v1::Settings settings;
    *settings.mutable_method() = choice;
    settings.set_depth(4);
    const auto xyz =
        resolve(*make_method(make_plan(scene, settings, {.threads = 1}), scene), gather);
    EXPECT_LT(patch_difference({xyz[0], xyz[1], xyz[2]}, reference), 0.1)
        << choice.ShortDebugString();
  }
}

TEST(Fluorescence, IsNotOfLightThatMetSomethingBefore) {
  const RenderScene scene =
      compile_text(patch_scene("standard: 'D65'", 1, material_text(patch_yield)));
  const RenderScene plain = compile_text(patch_scene("standard: 'D65'", 1, material_text(0)));
  const auto seen = [](const RenderScene& scene, bool before) {
    Gather gather = gather_for(scene);
    const Factor grey{FactorKind::specular, 0, 1};
    const std::uint32_t chain =
        before ? gather.chain(gather.chain_before(0, grey), grey) : gather.chain(0, grey);
    gather.weights(gather.surface(chain, 0), 0).diffuse = 1;
    return metamer::Reference(scene, cie::observer_1931()).resolve(gather, 1)[2];
  };
  EXPECT_EQ(seen(scene, true), seen(plain, true));
  EXPECT_GT(seen(scene, false), 1.05 * seen(plain, false));
}

TEST(Fluorescence, IsInTheTablesForAGpu) {
  const RenderScene scene =
      compile_text(patch_scene("standard: 'D65'", 0.7, material_text(patch_yield)));
  const FactorRows rows(scene);
  for (const v1::Method& choice : all_methods()) {
    const auto method = patch_method(choice, scene);
    const auto expected = resolve(*method, patch_of(scene, 0.6f));
    const DirectTables tables = method->direct_tables();
    const std::size_t at = 4 * std::size_t{rows.direct_diffuse(0)} * tables.row_stride;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      double sum = 0;
      for (std::size_t i = 0; i < 4 * std::size_t{tables.size}; ++i)
        sum += 0.6 * tables.values[at + i] * tables.sensors[axis * 4 * tables.size + i];
      EXPECT_NEAR(sum, expected[axis], 1e-5 * expected[1]) << choice.ShortDebugString();
    }
  }
}

std::vector<std::string> scene_notices(const RenderScene& scene) {
  std::vector<std::string> all;
  for (const RenderScene::Notice& one : scene.notices)
    all.push_back(one.field + ": " + one.message);
  return all;
}

TEST(Fluorescence, SaysFromWhereLightCountsAndWhatHasNoDataThere) {
  using Notices = std::vector<std::string>;
  const auto told = [](const std::string& light) {
    return scene_notices(compile_text(patch_scene(light, 1, material_text(patch_yield))));
  };
  const std::string left_out =
      "material[0].fluorescence: 1.1 % of its emission would be at shorter wavelengths than what "
      "it absorbs of white light, and is left out";
  EXPECT_EQ(told("standard: 'D65'"),
            (Notices{left_out,
                     "light[0].spectrum: wavelengths of light \"l\" count from 300 nm on, "
                     "where material \"paper\" absorbs to re-radiate"}));
  EXPECT_EQ(told("standard: 'F11'"),
            (Notices{left_out,
                     "light[0].spectrum: the data of light \"l\" begin at 380 nm: "
                     "material \"paper\" absorbs to re-radiate from 300 nm on, where "
                     "this light is taken for dark"}));
  EXPECT_EQ(told("line { nm: 633 power: 1 }"),
            (Notices{left_out,
                     "material[0].fluorescence: material \"paper\" re-radiates nothing: "
                     "no light excites it"}));
}

TEST(Fluorescence, ThatNoLightReachesChangesNothing) {
  const std::string laser = "line { nm: 633 power: 1 }";
  const RenderScene scene = compile_text(patch_scene(laser, 1, material_text(patch_yield)));
  const Xyz white = white_of(scene.emissions[0], cie::observer_1931());
  for (const v1::Method& choice : {exact(), fitted(8), prefilter()})
    EXPECT_NEAR(patch_seen_by(choice, scene)[1], 0.8 * white[1], 1e-5) << choice.ShortDebugString();
}

}  // namespace
}  // namespace metamer::test
