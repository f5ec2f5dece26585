// How far a picture's pixels are off because light is sampled.
#include "server/render/noise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "common/scene/settings.h"
#include "server/cpu/probe.h"
#include "server/scene/camera_space.h"
#include "tests/server/methods/methods.h"
#include "tests/server/test_scene.h"

namespace metamer::test {
namespace {

/// A floor under half of a lamp, beside a wall: soft shadows, and light between the two.
std::string corner_scene(const std::string& settings) {
  return "camera { eye { y: 1 z: 3 } target { y: 0.5 } } "
         "light { name: 'l' quad { corner { x: -1 y: 2 z: -1 } u { x: 2 } v { z: 2 } } spectrum { "
         "standard: 'D65' } luminance: 2 } material { name: 'm' diffuse { constant: 0.7 } } "
         "object { name: 'floor' material: 'm' plane {} } "
         "object { name: 'wall' material: 'm' quad { corner { x: -0.5 } u { x: 1 } v { y: 1 } } } "
         "settings { width: 64 height: 48 threads: 1 " +
         settings + " }";
}

const std::atomic<bool> never = false;

std::optional<v1::ColorError> noise_of(const std::string& text) {
  const RenderScene scene = to_camera_space(compile_text(text));
  v1::Settings settings = with_defaults(parse_scene(text).settings());
  const Capabilities capabilities{.threads = 1};
  *settings.mutable_method() = rgb();
  const v1::Plan plan = make_plan(scene, settings, capabilities);
  const auto geometry = std::make_shared<cpu::Geometry>(scene, 1);
  cpu::TracingProbe probe(geometry);
  probe.prepare(never);
  std::atomic<std::uint64_t> work = 0;
  return sampling_noise({scene, probe, settings, capabilities, never, work}, plan,
                        *make_method(plan, scene), white_of(scene.emissions[0], scene.observer));
}

/// What it estimates: how far the pixels of a picture are from what they are with 64 times as many
/// samples.
double mean_error(const std::string& few, const std::string& many) {
  const Rendered picture = render(corner_scene(few + " method { rgb {} }")),
                 truth = render(corner_scene(many + " method { rgb {} }"));
  double sum = 0;
  const auto lab = [](const std::array<float, 3>& c) {
    return to_lab({c[0], c[1], c[2]}, {0.9505, 1, 1.089});
  };
  for (std::uint32_t y = 0; y < 48; ++y)
    for (std::uint32_t x = 0; x < 64; ++x)
      sum += delta_e_00(lab(picture.at(x, y)), lab(truth.at(x, y)));
  return sum / (64 * 48);
}

TEST(SamplingNoise, IsTheDistanceToAPictureOfManySamples) {
  const std::string few = "spp: 4 light_samples: 1 bounces: 1 bounce_samples: 1",
                    many = "spp: 4 light_samples: 64 bounces: 1 bounce_samples: 64";
  const auto noise = noise_of(corner_scene(few));
  ASSERT_TRUE(noise);
  const double error = mean_error(few, many);
  EXPECT_GT(error, 0.5);
  EXPECT_NEAR(noise->mean() / error, 1, 0.35);  // of few pixels, some of them dark
  EXPECT_GT(noise->share(), 0);
}

TEST(SamplingNoise, FallsWithMoreSamples) {
  const auto few = noise_of(corner_scene("spp: 4 light_samples: 1")),
             many = noise_of(corner_scene("spp: 4 light_samples: 64"));
  EXPECT_LT(many->mean(), few->mean() / 8);  // the square root, at least
}

TEST(SamplingNoise, IsNotEstimatedWhereNothingIsSampled) {
  EXPECT_FALSE(
      noise_of("camera { eye { y: 1 z: 3 } target {} } light { name: 'l' position { y: 3 } "
               "spectrum { standard: 'D65' } } "
               "material { name: 'm' diffuse { constant: 0.7 } } object { name: 'o' "
               "material: 'm' plane {} } settings { width: 16 height: 16 }"));
}

}  // namespace
}  // namespace metamer::test
