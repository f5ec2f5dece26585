// What methods make of light through coloured liquids.

#include <gtest/gtest.h>

#include "common/color/lab.h"
#include "common/scene/settings.h"
#include "server/cpu/tracer.h"
#include "server/film/factor_sink.h"
#include "server/plan/plan.h"
#include "server/plan/reference.h"
#include "server/scene/camera_space.h"
#include "tests/server/methods/methods.h"
#include "tests/server/test_scene.h"

namespace metamer::test {
namespace {

/// A glass ball with an amber liquid in it, before two cards, on a mirror.
const char* const text = R"(
  camera { eye { y: 1 z: 5 } target { y: 0.4 } }
  light { name: "key" position { x: 2 y: 4 z: 3 } spectrum { standard: "D65" } luminance: 0.8 }
  light { name: "lamp" position { x: -2 y: 3 z: 2 } spectrum { standard: "F11" } luminance: 0.4 }
  material { name: "glass" fresnel { dielectric { medium: "N-BK7" } } transmission { priority: 1 } }
  material {
    name: "amber" fresnel { dielectric { medium: "water" } }
    transmission {
      transmittance { samples { wavelength: [400, 450, 500, 550, 600, 700] value: [0.001, 0.02, 0.2, 0.6, 0.9, 0.97] } }
      thickness: 0.5
    }
  }
  material { name: "red" diffuse { samples { wavelength: [400, 580, 620, 700] value: [0.05, 0.05, 0.6, 0.7] } } }
  material { name: "blue" diffuse { samples { wavelength: [400, 480, 520, 700] value: [0.6, 0.5, 0.1, 0.05] } } }
  material { name: "steel" mirror: 0.9 fresnel { conductor { metal: "Cu" } } }
  object { name: "wall" material: "red" quad { corner { x: -4 y: -1 z: -2 } u { x: 4 } v { y: 5 } } }
  object { name: "door" material: "blue" quad { corner { y: -1 z: -2 } u { x: 4 } v { y: 5 } } }
  object { name: "floor" material: "steel" quad { corner { x: -4 y: -0.7 z: 4 } u { x: 8 } v { z: -8 } } }
  object { name: "ball" material: "glass" sphere { radius: 0.7 } }
  object { name: "liquid" material: "amber" sphere { radius: 0.55 } }
  object { name: "bubble" material: "amber" sphere { center { x: 1.4 } radius: 0.5 } }
  settings { width: 24 height: 16 spp: 1 depth: 8 }
)";

class ClearThings : public ::testing::Test {
 protected:
  const RenderScene scene_ = to_camera_space(compile_text(text));
  const std::optional<cpu::EmbreeScene> geometry_ = cpu::EmbreeScene::build(scene_, never_);
  static inline const std::atomic<bool> never_ = false;

  v1::Plan plan(const v1::Method& method) const {
    v1::Settings settings = parse_scene(text).settings();
    *settings.mutable_method() = method;
    return make_plan(scene_, with_defaults(settings), {.threads = 1});
  }

  struct Gathers : PixelSink {
    std::vector<Gather> all;
    void take(std::uint32_t, std::uint32_t, const Gather& gather) override {
      all.push_back(gather);
    }
  };
  std::vector<Gather> gathers() const {
    const cpu::Tracer tracer(scene_, *geometry_, plan(exact()));
    auto workspace = tracer.make_workspace();
    std::atomic<std::uint64_t> work = 0;
    Gathers sink;
    tracer.render({0, 0, 24, 16}, sink, workspace, never_, work);
    return std::move(sink.all);
  }
};

TEST_F(ClearThings, ExactIsTheReference) {
  Reference reference(scene_, cie::observer_1931());
  const auto method = make_method(plan(exact()), scene_);
  const auto scratch = method->make_scratch();
  double worst = 0;
  std::size_t coloured = 0;
  for (const Gather& gather : gathers()) {
    const Xyz own = reference.resolve(gather, 1);
    const std::array<float, 3> xyz = method->resolve(gather, 1, *scratch);
    worst = std::max(worst, delta_e_00(to_lab({xyz[0], xyz[1], xyz[2]}, reference.white()),
                                       to_lab(own, reference.white())));
    for (const Gather::Chain& chain : gather.chains())
      coloured += chain.factor.kind == FactorKind::absorb;
  }
  EXPECT_GT(coloured, 100u);
  EXPECT_LT(worst, 0.02);
}

TEST_F(ClearThings, OtherMethodsAreNearIt) {
  Reference reference(scene_, cie::observer_1931());
  const std::vector<Gather> pixels = gathers();
  for (const auto& [method, allowed] : {std::pair{fitted(12), 2.0},
                                        {linear(8, v1::Linear::OBSERVER, true), 5.0},
                                        {cells(380, 780, 5), 1.0}}) {
    const auto made = make_method(plan(method), scene_);
    const auto scratch = made->make_scratch();
    double worst = 0;
    for (const Gather& gather : pixels) {
      const std::array<float, 3> xyz = made->resolve(gather, 1, *scratch);
      worst = std::max(worst, delta_e_00(to_lab({xyz[0], xyz[1], xyz[2]}, reference.white()),
                                         to_lab(reference.resolve(gather, 1), reference.white())));
    }
    EXPECT_LT(worst, allowed) << method.ShortDebugString();
    std::printf("%s: ΔE00 %.3f at most\n", method.ShortDebugString().c_str(), worst);
  }
}

}  // namespace
}  // namespace metamer::test
