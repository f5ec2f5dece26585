// Every pixel against the reference, and what is known of all pixels from some.
#include "server/render/verify.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/scene/settings.h"
#include "server/cpu/probe.h"
#include "server/cpu/renderer.h"
#include "server/cpu/tracer.h"
#include "server/scene/camera_space.h"
#include "server/transport/factor_rows.h"
#include "tests/server/methods/lamps.h"
#include "tests/server/methods/methods.h"
#include "tests/server/test_scene.h"

namespace metamer::test {
namespace {

/// Two balls that see each other, under mercury's lines.
std::string mirrors_scene() {
  const Lamp& mercury = lamps()[4];
  std::string text =
      "camera { eye { z: 5 } target {} } settings { width: 40 height: 24 spp: 4 depth: 2 threads: "
      "2 } light { name: 'l' position { x: 2 y: 3 z: 3 } spectrum { " +
      text_of(samples_of(mercury)) + " } }";
  const std::pair<const char*, const char*> paints[] = {
      {"-0.7", "samples { wavelength: [400, 540, 550, 700] value: [0.2, 0.3, 0.8, 0.7] }"},
      {"0.7", "samples { wavelength: [400, 430, 440, 700] value: [0.7, 0.6, 0.2, 0.1] }"}};
  for (const auto& [x, paint] : paints)
    text += " material { name: '" + std::string(x) + "' mirror: 0.5 diffuse { " + paint +
            " } specular { " + paint + " } } object { name: '" + x + "' material: '" + x +
            "' sphere { center { x: " + x + " } radius: 0.6 } }";
  return text;
}

/// A picture by a method, and what a verification makes of it.
class Verified : public testing::Test {
 protected:
  Verified() : scene_(to_camera_space(compile_text(mirrors_scene()))) {
    renderer_->prepare(never_);
  }

  void draw(const v1::Method& choice) {
    v1::Settings settings = with_defaults(parse_scene(mirrors_scene()).settings());
    *settings.mutable_method() = choice;
    plan_ = make_plan(scene_, settings, {.threads = 2});
    method_ = make_method(plan_, scene_);
    xyz_.assign(std::size_t{plan_.width()} * plan_.height() * 3, 0);
    ASSERT_TRUE(renderer_->change(plan_, *method_, never_));
    renderer_->begin({.film = film(),
                      .samples = sample_pattern(plan_.spp()),
                      .tiles = {},
                      .tile_done = {},
                      .keep_factors = false});
    ASSERT_TRUE(*renderer_->draw(control()));
  }

  v1::Accuracy verify() {
    Verification check(scene_, plan_, film());
    std::atomic<std::uint32_t> last = 0, calls = 0;
    EXPECT_TRUE(renderer_->change(check.plan(), check.method(), never_));
    renderer_->begin(check.picture([&](std::uint32_t tiles) {
      ++calls;
      if (tiles == check.tiles()) last = tiles;
    }));
    EXPECT_TRUE(*renderer_->draw(control()));
    EXPECT_EQ(calls, 6u);  // 40 × 24 in tiles of 16
    EXPECT_EQ(last, 6u);
    return check.accuracy();
  }

  Film film() { return {xyz_.data(), plan_.width(), plan_.height()}; }
  Control control() {
    return {never_, [] { return false; }, work_};
  }

  const std::atomic<bool> never_ = false;
  std::atomic<std::uint64_t> work_ = 0;
  RenderScene scene_;
  std::unique_ptr<Renderer> renderer_ =
      cpu::make_backend(2, cpu::Isa::avx2)->make_renderer(scene_, "");
  v1::Plan plan_;
  std::unique_ptr<Method> method_;
  std::vector<float> xyz_;
};

/// Each pixel's ΔE00, from the tracer and the reference themselves.
class ErrorSink : public PixelSink {
 public:
  ErrorSink(const RenderScene& scene, const Film& film, std::uint32_t spp)
      : reference_(scene, cie::observer_1931()), film_(film), spp_(spp) {}
  void take(std::uint32_t x, std::uint32_t y, const Gather& gather) override {
    const float* seen = film_.xyz + (std::size_t{y} * film_.width + x) * 3;
    const Xyz& white = reference_.white();
    errors.push_back(delta_e_00(to_lab({seen[0], seen[1], seen[2]}, white),
                                to_lab(reference_.resolve(gather, 1.0 / spp_), white)));
  }
  std::vector<double> errors;

 private:
  Reference reference_;
  Film film_;
  std::uint32_t spp_;
};

TEST_F(Verified, IsWhatTracingEachPixelAndResolvingItByTheReferenceGives) {
  draw(rgb());
  const v1::Accuracy accuracy = verify();

  cpu::Geometry geometry(scene_, 1);
  ASSERT_TRUE(geometry.prepare(never_));
  const cpu::Tracer tracer(scene_, geometry.embree(), plan_);
  auto workspace = tracer.make_workspace();
  ErrorSink sink(scene_, film(), plan_.spp());
  tracer.render({0, 0, plan_.width(), plan_.height()}, sink, workspace, never_, work_);
  const v1::ColorError direct = summarize(sink.errors);

  EXPECT_GT(direct.maximum(), 5);
  EXPECT_NEAR(accuracy.error().maximum(), direct.maximum(), 1e-3);
  EXPECT_NEAR(accuracy.error().percentile_95(), direct.percentile_95(), 1e-3);
  EXPECT_NEAR(accuracy.error().mean(), direct.mean(), 1e-4);
  EXPECT_EQ(accuracy.error().pixels(), 40u * 24);
  EXPECT_EQ(accuracy.error().share(), 1);
}

TEST_F(Verified, ExactIsAndOnePixelThatIsNotIsFound) {
  draw(exact());
  EXPECT_LT(verify().error().maximum(), 0.05);
  xyz_[(12 * 40 + 13) * 3 + 1] *= 1.1f;
  const v1::ColorError error = verify().error();
  EXPECT_GT(error.maximum(), 1);
  EXPECT_LT(error.percentile_95(), 0.05);
  xyz_[(12 * 40 + 13) * 3 + 1] = NAN;
  EXPECT_EQ(verify().error().maximum(), std::numeric_limits<double>::infinity());
}

TEST(ReferenceMethodTest, ItsTablesAreItsSums) {
  const RenderScene scene = compile_text(mirrors_scene());
  const ReferenceMethod method(scene, cie::observer_1964());
  const DirectTables tables = method.direct_tables();
  const FactorRows rows(scene);
  for (std::uint32_t material = 0; material < 2; ++material) {
    Gather gather(1);
    gather.weights(gather.surface(0, material), 0) = {0.75f, 0, 0};
    const auto resolved = resolve(method, gather);
    for (std::uint32_t axis = 0; axis < 3; ++axis) {
      double sum = 0;
      for (std::uint32_t i = 0; i < 4 * tables.size; ++i)
        sum += double{tables.sensors[4 * tables.size * axis + i]} *
               tables.values[4 * tables.row_stride * rows.diffuse(material) + i] * 0.75;
      EXPECT_NEAR(sum, resolved[axis], 2e-5 * (resolved[1] + resolved[axis]));
    }
  }
}

// Wilks's sample sizes: 59 for 95 % of the population, 299 for 99 %, each with 95 % confidence.
TEST(BoundedShare, HasThePublishedSampleSizes) {
  EXPECT_GE(bounded_share(59), 0.95);
  EXPECT_LT(bounded_share(58), 0.95);
  EXPECT_GE(bounded_share(299), 0.99);
  EXPECT_LT(bounded_share(298), 0.99);
}

// Runs of 32 random pixels, of a picture of which a known share sees a ball: the largest of a run
// fails to bound the share of the others in about 5 % of the runs, were they drawn independently.
TEST(RandomPixels, AreDrawnEachByItself) {
  const std::string text =
      "camera { eye { z: 5 } target {} } settings { width: 64 height: 64 spp: 8 } light { name: "
      "'l' position { z: 9 } spectrum { standard: 'E' } } material { name: 'm' } object { name: "
      "'b' "
      "material: 'm' sphere { radius: 0.52 } }";
  const RenderScene scene = to_camera_space(compile_text(text));
  const auto geometry = std::make_shared<cpu::Geometry>(scene, 1);
  cpu::TracingProbe probe(geometry);
  const std::atomic<bool> never = false;
  std::atomic<std::uint64_t> work = 0;
  ASSERT_TRUE(probe.prepare(never));
  v1::Settings settings = with_defaults(parse_scene(text).settings());
  const v1::Plan plan = make_plan(scene, settings, {.threads = 1});
  const auto seen = [&](PixelRun run) {
    double count = 0;
    for (const Gather& gather : probe.trace(plan, run, never, work).gathers)
      count += !gather.surfaces().empty();
    return count;
  };
  constexpr std::uint32_t run_size = 32, runs = 2000;
  const double share = seen({0, 64 * 64, false}) / (64 * 64);
  EXPECT_NEAR(share, 1 - bounded_share(run_size), 0.01);  // so the chance of none is 5 %
  std::uint32_t none = 0;
  double all = 0;
  for (std::uint32_t i = 0; i < runs; ++i) {
    const double count = seen({i * run_size, run_size, true});
    none += count == 0;
    all += count;
  }
  // Four standard deviations of the binomials.
  EXPECT_NEAR(all / (runs * run_size), share,
              4 * std::sqrt(share * (1 - share) / (runs * run_size)));
  const double chance = std::pow(1 - share, run_size);
  EXPECT_NEAR(static_cast<double>(none) / runs, chance,
              4 * std::sqrt(chance * (1 - chance) / runs));
}

}  // namespace
}  // namespace metamer::test
