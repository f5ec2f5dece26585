// What a GPU is given at the ends: shapes without area, cameras inside things, pictures of one
// pixel and of many, more wavelengths than a uniform block holds, and one scene after the other.

#include <gtest/gtest.h>
#include <sys/mman.h>

#include <cmath>
#include <cstdlib>
#include <fstream>

#include "common/scene/settings.h"
#include "server/cpu/tracer.h"
#include "server/gl/device.h"
#include "server/gl/renderer.h"
#include "server/plan/plan.h"
#include "server/scene/camera_space.h"
#include "tests/server/test_scene.h"

namespace metamer::gl {
namespace {

const std::atomic<bool> no_stop = false;

class GlExtremes : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    setenv("MESA_SHADER_CACHE_DISABLE", "1", 1);
    auto made = Device::create("auto");
    ASSERT_TRUE(made) << made.error().message << ": see deploy/dependencies";
    device_ = std::make_unique<Device>(std::move(*made));
  }
  static void TearDownTestSuite() { device_.reset(); }

  /// A region of the scene's picture, all of it where none is given.
  static std::vector<float> render(const std::string& text, std::optional<Rect> region = {}) {
    return render(to_camera_space(test::compile_text(text)), text, region);
  }
  static std::vector<float> render(const RenderScene& scene, const std::string& text,
                                   std::optional<Rect> region = {}) {
    const v1::Plan plan =
        make_plan(scene, with_defaults(test::parse_scene(text).settings()), {.threads = 1});
    std::vector<float> xyz(std::size_t{plan.width()} * plan.height() * 3, -1.0f);
    render_into({xyz.data(), plan.width(), plan.height()}, scene, text,
                region.value_or(Rect{0, 0, plan.width(), plan.height()}));
    return xyz;
  }
  static inline std::atomic<std::uint64_t> work;  ///< Of the last picture.
  static Result<bool> draw(Renderer& renderer, const Film& film, unsigned spp, const Rect& region) {
    work = 0;
    renderer.begin({.film = film,
                    .samples = sample_pattern(spp),
                    .tiles = {region},
                    .tile_done = {},
                    .keep_factors = false});
    return renderer.draw({no_stop, [] { return false; }, work});
  }
  static void render_into(const Film& film, const RenderScene& scene, const std::string& text,
                          const Rect& region) {
    const v1::Plan plan =
        make_plan(scene, with_defaults(test::parse_scene(text).settings()), {.threads = 1});
    const auto method = make_method(plan, scene);
    const auto renderer = make_backend(*device_, 1)->make_renderer(scene, text);
    const auto changed = renderer->change(plan, *method, no_stop);
    ASSERT_TRUE(changed) << changed.error().message;
    const auto whole = draw(*renderer, film, plan.spp(), region);
    ASSERT_TRUE(whole) << whole.error().message;
    EXPECT_TRUE(*whole);
  }

  /// As far as the CPU's picture goes, per value; both without mirrors.
  static void expect_as_cpu(const std::string& text) {
    const test::Rendered cpu = test::render(text);
    const std::vector<float> gl = render(text);
    ASSERT_EQ(gl.size(), cpu.xyz.size());
    float brightest = 0;
    for (const float value : cpu.xyz) brightest = std::max(brightest, value);
    EXPECT_GT(brightest, 0);
    std::size_t off = 0;
    for (std::size_t i = 0; i < gl.size(); ++i) {
      ASSERT_TRUE(std::isfinite(gl[i])) << i;
      off += std::abs(gl[i] - cpu.xyz[i]) > 1e-4f * brightest;
    }
    // Edges may fall to either side.
    EXPECT_LE(off, gl.size() / 50 + 3);
  }

  static inline std::unique_ptr<Device> device_;
};

std::string scene(const std::string& settings, const std::string& more,
                  const std::string& camera = "eye { y: 1 z: 5 } target {}") {
  return "camera { " + camera + " } settings { " + settings +
         " backend: GL depth: 0 } light { name: \"a\" position { x: 1 y: 3 z: 4 } spectrum { "
         "standard: "
         "\"F11\" } } material { name: \"m\" diffuse { constant: 0.5 } blinn_phong {} } object { "
         "name: "
         "\"floor\" material: \"m\" quad { corner { x: -9 y: -1 z: 9 } u { x: 18 } v { z: -18 } } "
         "} " +
         more;
}

const std::string ball =
    "object { name: \"ball\" material: \"m\" sphere { center {} radius: 0.8 } } ";

TEST_F(GlExtremes, TrianglesWithoutAreaAreNotSeen) {
  const std::string text = scene("width: 64 height: 48 spp: 4", ball);
  RenderScene degenerate = to_camera_space(test::compile_text(text));
  TriangleMesh& floor = degenerate.meshes.front();
  const auto& corners = floor.positions.f32();
  std::vector<Float3> positions(corners.begin(), corners.end());
  positions.push_back(positions.front());  // a line: twice the same place
  std::vector<Triangle> triangles = {{0, 0, 0}, {0, 1, 1}, {0, 4, 2}};
  triangles.insert(triangles.end(), floor.triangles.begin(), floor.triangles.end());
  floor.positions = Array(positions);
  floor.triangles = triangles;
  const std::vector<float> with = render(degenerate, text + " # degenerate");
  EXPECT_EQ(with, render(text));
}

TEST_F(GlExtremes, SamplesOnTheEdgeOfTwoSurfacesAreNotInTheirOwnShadow) {
  // Floor and wall meet in the middle row of pixels, at many angles.
  for (int i = 0; i < 40; ++i) {
    const std::string text =
        "camera { eye { y: " + std::to_string(0.3 + 0.07 * i) +
        " z: 4 } target {} } settings { width: 41 height: 31 spp: 1 depth: 0 backend: GL } light { "
        "name: \"a\" position { x: 1 y: 3 z: 3 } spectrum { standard: \"D65\" } } material { name: "
        "\"m\" diffuse { constant: 0.5 } } object { name: \"floor\" material: \"m\" quad { corner "
        "{ x: "
        "-9 } u { x: 18 } v { z: 9 } } } object { name: \"wall\" material: \"m\" quad { corner { "
        "x: -9 } "
        "u { x: 18 } v { y: 9 } } }";
    const std::vector<float> xyz = render(text);
    const float* row = &xyz[std::size_t{15} * 41 * 3];
    for (int x = 0; x < 41; ++x) ASSERT_GT(row[3 * x + 1], 0.01f) << i << ' ' << x;
  }
}

TEST_F(GlExtremes, TheCameraMayBeInsideABall) {
  expect_as_cpu(
      scene("width: 64 height: 48 spp: 4",
            "object { name: \"around\" material: \"m\" sphere { center {} radius: 20 } } " + ball));
}

TEST_F(GlExtremes, EllipsoidsAreWhatTheyAreOnTheCpu) {
  expect_as_cpu(
      scene("width: 64 height: 48 spp: 4",
            "object { name: \"egg\" material: \"m\" sphere { center {} radius: 0.5 } transform { "
            "scale { x: 2 y: 1 z: 0.5 } } transform { rotate { axis { z: 1 } degrees: 30 } } }"));
}

TEST_F(GlExtremes, APictureMayHaveOnePixel) {
  expect_as_cpu(scene("width: 1 height: 1 spp: 16", ball));
}

TEST_F(GlExtremes, FourThousandWavelengthsAreSummedAsOnTheCpu) {
  expect_as_cpu(
      scene("width: 48 height: 32 spp: 1 method { point { from: 380 to: 780 step: 0.1 } }", ball));
}

TEST_F(GlExtremes, TheSameLightFarOutAndTiny) {
  // A thousand kilometres away, and a micrometre large.
  for (const auto& [shift, size] : {std::pair{1e6, 1.0}, {0.0, 1e-6}}) {
    char text[1200];
    std::snprintf(
        text, sizeof text,
        "camera { eye { x: %.17g y: %.17g z: %.17g } target { x: %.17g } } settings { width: 64 "
        "height: 48 spp: 4 depth: 0 backend: GL } light { name: \"a\" direction { y: -1 z: -1 } "
        "spectrum { standard: \"D65\" } } material { name: \"m\" diffuse { constant: 0.5 } } "
        "object { name: \"b\" material: \"m\" sphere { center { x: %.17g } radius: %.17g } }",
        shift, size, 5 * size, shift, shift, 0.8 * size);
    SCOPED_TRACE(shift);
    expect_as_cpu(text);
  }
}

TEST_F(GlExtremes, RegionsMakeTheWholePictureBitByBit) {
  const std::string text = scene("width: 100 height: 60 spp: 2", ball);
  const std::vector<float> whole = render(text);
  for (const Rect& region : {Rect{0, 0, 40, 24}, Rect{40, 0, 60, 24}, Rect{0, 24, 100, 36}}) {
    const std::vector<float> part = render(text, region);
    for (std::uint32_t y = region.y; y < region.y + region.height; ++y)
      for (std::uint32_t i = 3 * region.x; i < 3 * (region.x + region.width); ++i)
        ASSERT_EQ(part[y * 300 + i], whole[y * 300 + i]) << i / 3 << ' ' << y;
  }
}

TEST_F(GlExtremes, ACornerOfTheLargestPictureIsItsOwnRegion) {
  // 3 GiB, of which the system gives only what is touched.
  constexpr std::uint32_t side = 16384;
  const std::size_t bytes = std::size_t{side} * side * 12;
  void* const memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE,
                            MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  ASSERT_NE(memory, MAP_FAILED);
  const Film film{static_cast<float*>(memory), side, side};
  const Rect corner{side - 64, side - 48, 64, 48};
  const std::string text = scene("width: 16384 height: 16384 spp: 1", ball);
  render_into(film, to_camera_space(test::compile_text(text)), text, corner);

  // The floor.
  std::size_t lit = 0;
  for (std::uint32_t y = corner.y; y < side; ++y)
    for (std::uint32_t x = corner.x; x < side; ++x)
      lit += film.xyz[(std::size_t{y} * side + x) * 3 + 1] > 0;
  EXPECT_EQ(lit, std::size_t{corner.width} * corner.height);
  EXPECT_EQ(film.xyz[(std::size_t{corner.y} * side + corner.x - 1) * 3 + 1], 0) << "not its own";
  munmap(memory, bytes);
}

TEST_F(GlExtremes, MultiplePassesGiveTheSameSums) {
  for (const std::string shading : {"PHONG", "CONSTANT", "GOURAUD", "QUADRATIC"}) {
    const std::string point = "width: 64 height: 48 spp: 4 shading: " + shading +
                              " method { point { from: 400 to: 700 step: 10 ";
    const std::vector<float> one = render(scene(point + "} }", ball));
    const std::vector<float> many = render(scene(point + "multi_pass: true } }", ball));
    // A pass by software may take longer than a daemon waits for a sign of life.
    const std::uint64_t samples = 4, passes = 8;
    EXPECT_EQ(work, samples * (64 * 48 + passes));
    float brightest = 0;
    for (const float value : one) brightest = std::max(brightest, value);
    EXPECT_GT(brightest, 0);
    for (std::size_t i = 0; i < one.size(); ++i)
      ASSERT_NEAR(one[i], many[i], 1e-5f * brightest) << shading << ' ' << i;
  }
}

TEST_F(GlExtremes, ACameraThatMovesSeesWhatOneThatStoodThereSees) {
  for (const std::string shading : {"PHONG", "GOURAUD"}) {
    const std::string text =
        scene("width: 64 height: 48 spp: 4 method { exact {} } shading: " + shading, ball);
    RenderScene here = test::compile_text(text);
    RenderScene there = here;
    there.camera.eye += Eigen::Vector3d(0.7, 0.4, 0.3);
    // From the space of the first camera, in which the geometry stays, and from its own.
    const CameraSpace space = CameraSpace::of(here);
    space.place(here);
    render(here, text + " # moved");
    RenderScene moved = there;
    space.place(moved);
    const std::vector<float> gl = render(moved, text + " # moved");
    const std::vector<float> expected = render(to_camera_space(there), text + " # there");
    float brightest = 0;
    std::size_t different = 0;
    for (const float value : expected) brightest = std::max(brightest, value);
    EXPECT_GT(brightest, 0);
    for (std::size_t i = 0; i < gl.size(); ++i)
      different += std::abs(gl[i] - expected[i]) > 1e-4f * brightest;
    // A sample on an edge may fall to either side.
    EXPECT_LE(different, gl.size() / 200) << shading;
  }
}

TEST_F(GlExtremes, WhatNoBufferHoldsIsAMessage) {
  const auto buffer = Buffer::zeros("the vertices' positions", std::size_t{1} << 40);
  ASSERT_FALSE(buffer);
  EXPECT_EQ(
      buffer.error().message.rfind("the vertices' positions take 1048576 MiB; this GL device's", 0),
      0u)
      << buffer.error().message;
}

TEST_F(GlExtremes, AContextThatGoesAwayUnderARendererIsAMessage) {
  const std::string text = scene("width: 16 height: 8 spp: 2", ball);
  const RenderScene own = to_camera_space(test::compile_text(text));
  const v1::Plan plan =
      make_plan(own, with_defaults(test::parse_scene(text).settings()), {.threads = 1});
  const auto method = make_method(plan, own);
  const auto backend = make_backend(*device_, 1);
  const auto renderer = backend->make_renderer(own, text);
  ASSERT_TRUE(renderer->change(plan, *method, no_stop));
  std::vector<float> xyz(16 * 8 * 3);
  const auto draw_all = [&] { return draw(*renderer, {xyz.data(), 16, 8}, 2, {0, 0, 16, 8}); };
  ASSERT_TRUE(draw_all());
  device_->context().release();
  const auto lost = draw_all();
  EXPECT_FALSE(backend->is_sound());
  ASSERT_FALSE(lost);
  EXPECT_EQ(lost.error().message, "the GL context is gone");
  ASSERT_TRUE(device_->context().make_current());
  EXPECT_TRUE(draw_all());
}

/// A floor of so many squares a side, a little hilly.
TriangleMesh hills(std::uint32_t side) {
  std::vector<Float3> positions;
  std::vector<Triangle> triangles;
  for (std::uint32_t z = 0; z <= side; ++z)
    for (std::uint32_t x = 0; x <= side; ++x) {
      const float u = static_cast<float>(x) / static_cast<float>(side);
      const float v = static_cast<float>(z) / static_cast<float>(side);
      positions.push_back(
          {6 * u - 3, 0.2f * std::sin(20 * u) * std::cos(20 * v) - 0.5f, -6 * v - 2});
    }
  const auto at = [=](std::uint32_t x, std::uint32_t z) { return z * (side + 1) + x; };
  for (std::uint32_t z = 0; z < side; ++z)
    for (std::uint32_t x = 0; x < side; ++x) {
      triangles.push_back({at(x, z), at(x + 1, z), at(x, z + 1)});
      triangles.push_back({at(x + 1, z), at(x + 1, z + 1), at(x, z + 1)});
    }
  TriangleMesh mesh;
  mesh.positions = Array(std::move(positions));
  mesh.triangles = std::move(triangles);
  return mesh;
}

// Half a minute and three gigabytes.
using LongGlExtremes = GlExtremes;
TEST_F(LongGlExtremes, TenMillionTrianglesAreSeenAsByTheCpu) {
  const std::string text =
      "camera { eye {} target { z: -1 } } settings { width: 64 height: 48 spp: 1 depth: 0 backend: "
      "GL "
      "method { rgb {} } } light { name: \"a\" direction { x: 1 y: -1 } spectrum { standard: "
      "\"D65\" } } "
      "material { name: \"m\" diffuse { constant: 0.5 } } object { name: \"floor\" material: \"m\" "
      "quad "
      "{ corner {} u { x: 1 } v { y: 1 } } }";
  RenderScene own = test::compile_text(text);
  own.meshes.front() = hills(2237);
  ASSERT_GT(own.triangle_count(), 10'000'000u);
  const std::vector<float> gl = render(own, text + " # hills");
  ASSERT_EQ(gl.size(), 64u * 48 * 3);

  const v1::Plan plan =
      make_plan(own, with_defaults(test::parse_scene(text).settings()), {.threads = 1});
  const auto method = make_method(plan, own);
  const auto geometry = cpu::EmbreeScene::build(own, no_stop);
  const cpu::Tracer tracer(own, *geometry, plan);
  std::vector<float> cpu(gl.size());
  FilmSink sink(*method, {cpu.data(), 64, 48}, 1);
  auto workspace = tracer.make_workspace();
  std::atomic<std::uint64_t> work = 0;
  tracer.render({0, 0, 64, 48}, sink, workspace, no_stop, work);
  std::size_t off = 0, lit = 0;
  for (std::size_t i = 0; i < gl.size(); ++i) {
    off += std::abs(gl[i] - cpu[i]) > 1e-3f;
    lit += cpu[i] > 0.01f;
  }
  EXPECT_GT(lit, gl.size() / 10);
  EXPECT_LT(off, gl.size() / 20);
}

std::size_t resident_bytes() {
  std::ifstream in("/proc/self/statm");
  std::size_t all = 0, resident = 0;
  in >> all >> resident;
  return resident * 4096;
}

TEST_F(GlExtremes, AThousandScenesLeaveNoMemoryBehind) {
  const auto change = [&](int i) {
    render(scene("width: 16 height: 8 spp: 1 method { rgb {} }",
                 "object { name: \"ball\" material: \"m\" sphere { center { x: " +
                     std::to_string(i * 1e-4) + " } radius: 0.8 } } "));
  };
  for (int i = 0; i < 100; ++i) change(i);
  const std::size_t before = resident_bytes();
  for (int i = 100; i < 1100; ++i) change(i);
  EXPECT_LT(resident_bytes(), before + (4u << 20));
}

}  // namespace
}  // namespace metamer::gl
