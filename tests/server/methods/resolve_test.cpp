// What a method makes of the gathered weights, against plain f64 sums over the CIE's tables.

#include <gtest/gtest.h>

#include "common/color/srgb.h"
#include "common/color/xyz.h"
#include "common/spectral/cie.h"
#include "server/methods/exact.h"
#include "server/methods/exact_tables.h"
#include "server/methods/method.h"
#include "server/plan/reference.h"
#include "server/transport/mirror.h"
#include "tests/server/methods/dense.h"
#include "tests/server/test_scene.h"

namespace metamer {
namespace {

/// Two lights, a paint with a coloured highlight and a tinted mirror.
const char* const scene_text = R"(
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
    name: "mirror" mirror: 0.5
    specular { samples { wavelength: [400, 550, 700] value: [0.2, 0.9, 0.4] } }
  }
  object { name: "o" material: "paint" sphere { radius: 1 } }
  object { name: "p" material: "mirror" sphere { center { x: 3 } radius: 1 } }
)";

v1::Plan plan_for(const v1::Method& method) {
  v1::Plan plan;
  *plan.mutable_method() = method;
  plan.set_depth(2);
  return plan;
}

/// A pixel that sees the paint directly and, over the mirror twice, the paint again.
Gather example_gather() {
  Gather gather(2);
  const auto seen = gather.surface(0, 0);
  gather.weights(seen, 0) = {0.5f, 0.25f, 0};
  gather.weights(seen, 1) = {0.125f, 0, 0};
  const Factor mirror{FactorKind::specular, 1, 1};
  const auto twice = gather.chain(gather.chain(0, mirror), mirror);
  gather.weights(gather.surface(twice, 0), 0) = {0.25f, 0.5f, 0.125f};
  return gather;
}

/// The same pixel by E[3.2-2] and E[2.2-3] in f64.
Xyz expected(const Wavelengths& wavelengths, const Observer& observer_choice) {
  const RenderScene scene = test::compile_text(scene_text);
  const auto& nm = wavelengths.nm();
  const ObserverWeights observer = observer_weights(observer_choice, wavelengths);
  const auto light = [&](std::size_t i) {
    auto power = resample(scene.emissions[scene.lights[i].emission], nm, Outside::zero).values;
    double y = 0;
    for (std::size_t k = 0; k < nm.size(); ++k) y += observer.weights[1][k] * power[k];
    for (double& value : power) value *= scene.lights[i].luminance / y;
    return power;
  };
  const auto property = [&](std::uint32_t i) {
    return resample(scene.properties[i], nm, Outside::hold).values;
  };
  const auto a = light(0), b = light(1);
  const auto diffuse = property(scene.materials[0].diffuse);
  const auto specular = property(scene.materials[0].specular);
  const auto mirror = property(scene.materials[1].specular);
  Xyz xyz{};
  for (std::size_t k = 0; k < nm.size(); ++k) {
    const double radiance =
        a[k] * (0.5 * diffuse[k] + 0.25 * specular[k]) + b[k] * 0.125 * diffuse[k] +
        mirror[k] * mirror[k] * a[k] * (0.25 * diffuse[k] + 0.5 * specular[k] + 0.125);
    for (std::size_t i = 0; i < 3; ++i) xyz[i] += observer.weights[i][k] * radiance;
  }
  return xyz;
}

TEST(Point, IsTheSumOverItsWavelengthsForEachSamplingAndObserver) {
  std::vector<v1::Method> methods(5);
  for (auto [i, step] : {std::pair{0, 50.0}, {1, 20.0}, {2, 5.0}, {3, 0.075}})
    methods[static_cast<std::size_t>(i)].mutable_point()->set_step(step);
  for (int i = 0; i < 4; ++i) {
    methods[static_cast<std::size_t>(i)].mutable_point()->set_from(400);
    methods[static_cast<std::size_t>(i)].mutable_point()->set_to(700);
  }
  for (double nm : {400.0, 436.0, 546.0, 611.0, 700.0})
    methods[4].mutable_point()->add_wavelengths(nm);

  RenderScene scene = test::compile_text(scene_text);
  for (const v1::Method& choice : methods)
    for (const Observer& observer : {cie::observer_1931(), cie::observer_1964()}) {
      scene.observer = observer;
      const auto xyz = test::resolve(*make_method(plan_for(choice), scene), example_gather());
      const Xyz exact = expected(method_wavelengths(choice), observer);
      for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(xyz[i] / exact[i], 1, 2e-6) << choice.ShortDebugString();
    }
}

TEST(Exact, IsTheIntegralOverAllThatTheSpectraSay) {
  v1::Method exact;
  exact.mutable_exact();
  RenderScene scene = test::compile_text(scene_text);
  for (const Observer& observer : {cie::observer_1931(), cie::observer_1964()}) {
    scene.observer = observer;
    const auto xyz = test::resolve(*make_method(plan_for(exact), scene), example_gather());
    const Xyz integral = expected(test::dense(), observer);
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_NEAR(xyz[i] / integral[i], 1, 6e-6);  // over a mirror
  }
}

TEST(Exact, ALightOfOneSampleIsALine) {
  for (const char* value : {"1", "1e-99", "1e15"}) {
    const RenderScene scene = test::compile_text(
        "camera { eye { z: 3 } target {} } light { name: 'l' position { y: 2 } spectrum { samples "
        "{ "
        "wavelength: 546.1 value: " +
        std::string(value) +
        " } } } material { name: 'm' diffuse { constant: 1 } } object { name: 'o' material: 'm' "
        "sphere { radius: 1 } }");
    v1::Method exact;
    exact.mutable_exact();
    Gather gather(1);
    gather.weights(gather.surface(0, 0), 0) = {1, 0, 0};
    const auto xyz = test::resolve(*make_method(plan_for(exact), scene), gather);
    const auto& functions = cie::observer_1931().functions();
    std::array<double, 3> seen;
    for (std::size_t i = 0; i < 3; ++i)
      seen[i] = resample(functions[i], {546.1}, Outside::zero).values[0];
    for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(xyz[i], seen[i] / seen[1], 1e-5) << value;
  }
}

TEST(Exact, KeepsToItOverMirrorsWithFresnelTermsHoweverMany) {
  const RenderScene scene = test::compile_text(R"(
    camera { eye { z: 3 } target {} }
    light { name: "a" position { y: 2 } spectrum { standard: "F11" } luminance: 0.8 }
    light { name: "b" position { y: 1 } spectrum { standard: "A" } luminance: 0.3 }
    material {
      name: "paint" specularness: 0.5 fresnel { conductor { metal: "Cu" } } hall_greenberg {}
      diffuse { samples { wavelength: [400, 500, 600, 700] value: [0.1, 0.7, 0.2, 0.5] } }
    }
    material { name: "gold" mirror: 1 fresnel { conductor { metal: "Au" } } }
    material { name: "lacquer" mirror: 1 specular { constant: 0.1 } fresnel { schlick {} } }
    object { name: "o" material: "paint" sphere { radius: 1 } })");
  const Observer& observer = cie::observer_1931();
  v1::Method exact;
  exact.mutable_exact();
  v1::Plan plan = plan_for(exact);
  plan.set_depth(7);
  const auto method = make_method(plan, scene);
  Reference reference(scene, observer);
  const auto scratch = method->make_scratch();
  // The memory lasts many pixels.
  for (unsigned mirrors = 0; mirrors <= 7; ++mirrors)
    for (unsigned pixel = 0; pixel < 40; ++pixel) {
      Gather gather(2);
      std::uint32_t chain = 0;
      for (std::uint32_t i = 0; i < mirrors; ++i) {
        const std::uint32_t mirror = 1 + i % 2;
        chain = gather.chain(chain, mirror_factor(scene.materials[mirror], mirror,
                                                  0.05f + 0.02f * static_cast<float>(pixel + i)));
      }
      const auto surface = gather.surface(chain, 0);
      gather.weights(surface, 0) = {0.5f, 0, 0.125f};
      gather.weights(surface, 1) = {0.25f, 0.25f, 0};
      gather.add(chain, 1, {FactorKind::fresnel, 0, 300 + pixel}, 0.5f);
      const auto xyz = method->resolve(gather, 1, *scratch);
      const Xyz expected = reference.resolve(gather, 1);
      for (std::size_t i = 0; i < 3; ++i)
        EXPECT_NEAR(xyz[i] / expected[i], 1, 1e-5) << mirrors << " mirrors";
    }
}

TEST(Point, AFlatSurfaceKeepsTheLightsColour) {
  Gather gather(1);
  gather.weights(gather.surface(0, 0), 0) = {1, 0, 0};
  for (const auto& name : cie::illuminant_names()) {
    const RenderScene scene = test::compile_text(
        "camera { eye { z: 3 } target {} } light { name: 'l' position { y: 2 } spectrum { "
        "standard: '" +
        name +
        "' } } material { name: 'm' diffuse { constant: 1 } } object { name: 'o' material: 'm' "
        "sphere { radius: 1 } }");
    v1::Method method;
    method.mutable_point()->set_from(380);
    method.mutable_point()->set_to(780);
    method.mutable_point()->set_step(1);
    const auto xyz = test::resolve(*make_method(plan_for(method), scene), gather);
    EXPECT_NEAR(xyz[1], 1, 1e-6) << name;
  }
}

TEST(Rgb, IsRightUnderD65AndWrongUnderF11) {
  // A saturated red (TCS09) seen under one light.
  const auto seen = [](const std::string& light, const v1::Method& method) {
    const RenderScene scene = test::compile_text(
        "camera { eye { z: 3 } target {} } light { name: 'l' position { y: 2 } spectrum { "
        "standard: '" +
        light +
        "' } } material { name: 'm' diffuse { samples { wavelength: [400, 560, 600, 640, 700] "
        "value: "
        "[0.05, 0.04, 0.2, 0.6, 0.7] } } } object { name: 'o' material: 'm' sphere { radius: 1 } "
        "}");
    Gather gather(1);
    gather.weights(gather.surface(0, 0), 0) = {1, 0, 0};
    return test::resolve(*make_method(plan_for(method), scene), gather);
  };
  v1::Method rgb, point;
  rgb.mutable_rgb();
  point.mutable_point()->set_from(380);
  point.mutable_point()->set_to(780);
  point.mutable_point()->set_step(1);
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(seen("D65", rgb)[i] / seen("D65", point)[i], 1, 0.01);
  EXPECT_GT(std::abs(seen("F11", rgb)[0] / seen("F11", point)[0] - 1), 0.05);
}

}  // namespace
}  // namespace metamer
