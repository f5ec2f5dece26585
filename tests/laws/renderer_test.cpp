// What every backend owes to those who draw by it: server/render/README.md.
#include "server/render/renderer.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <mutex>

#include "common/scene/settings.h"
#include "server/cpu/renderer.h"
#include "server/gl/renderer.h"
#include "server/plan/plan.h"
#include "server/scene/camera_space.h"
#include "tests/server/test_scene.h"

namespace metamer {
namespace {

constexpr const char* balls =
    "camera { eye { y: 1 z: 4 } target {} } light { name: 'lamp' position { x: 2 y: 3 z: 2 } "
    "spectrum { standard: 'D65' } } light { name: 'sun' direction { y: -1 } spectrum { standard: "
    "'A' } } material { name: 'paint' diffuse { constant: 0.5 } blinn_phong {} } object { name: "
    "'ball' material: 'paint' sphere { radius: 1 } } object { name: 'floor' material: 'paint' quad "
    "{ corner { x: -3 y: -1 z: 3 } u { x: 6 } v { z: -6 } } } settings { width: 80 height: 48 spp: "
    "4 method { exact {} } }";

struct Named {
  const char* name;
  std::unique_ptr<gl::Device> device;  ///< Outlives its backend.
  std::unique_ptr<Backend> backend;
};

/// Every backend there is. An environment without OpenGL is broken: see deploy/dependencies.
std::vector<Named> backends() {
  setenv("MESA_SHADER_CACHE_DISABLE", "1", 1);  // Or the cache lands in $HOME.
  std::vector<Named> all;
  all.push_back({"cpu", nullptr, cpu::make_backend(2, cpu::Isa::avx2)});
  auto device = gl::Device::create("auto");
  if (!device) throw std::runtime_error(device.error().message);
  auto kept = std::make_unique<gl::Device>(std::move(*device));
  auto backend = gl::make_backend(*kept, 2);
  all.push_back({"gl", std::move(kept), std::move(backend)});
  return all;
}

/// A scene and its renderer, ready to draw.
class Ready {
 public:
  explicit Ready(const Backend& backend) {
    renderer_ = backend.make_renderer(scene_, "balls");
    if (!renderer_->prepare(never_) || !renderer_->change(plan_, *method_, never_))
      throw std::runtime_error("not ready");
    clear();
  }

  void clear() { xyz_.assign(std::size_t{80} * 48 * 3, -1.0f); }

  void begin(std::vector<Rect> tiles, bool keep_factors = false) {
    std::lock_guard lock(mutex_);
    told_.clear();
    factors_.clear();
    renderer_->begin({.film = {xyz_.data(), 80, 48},
                      .samples = sample_pattern(4),
                      .tiles = std::move(tiles),
                      .tile_done =
                          [this](const DrawnTile& tile) {
                            const std::lock_guard lock(mutex_);
                            told_.push_back(tile.rect);
                            if (tile.factors) factors_.push_back(tile.factors->SerializeAsString());
                          },
                      .keep_factors = keep_factors});
  }
  /// Draws until the picture is whole; returns the number of turns.
  int draw(const std::function<bool()>& is_over) {
    for (int turns = 1; turns < 100000; ++turns) {
      const auto whole = renderer_->draw({never_, is_over, work_});
      if (!whole) throw std::runtime_error(whole.error().message);
      if (*whole) return turns;
    }
    throw std::runtime_error("never whole");
  }

  const std::atomic<bool> never_ = false;
  std::atomic<std::uint64_t> work_ = 0;
  RenderScene scene_ = to_camera_space(test::compile_text(balls));
  v1::Plan plan_ =
      make_plan(scene_, with_defaults(test::parse_scene(balls).settings()), {.threads = 2});
  std::unique_ptr<Method> method_ = make_method(plan_, scene_);
  std::unique_ptr<Renderer> renderer_;
  std::vector<float> xyz_;
  std::mutex mutex_;
  std::vector<Rect> told_;
  std::vector<std::string> factors_;
};

std::vector<Rect> tiles(std::uint32_t side) {
  std::vector<Rect> all;
  for (std::uint32_t y = 0; y < 48; y += side)
    for (std::uint32_t x = 0; x < 80; x += side)
      all.push_back({x, y, std::min(side, 80 - x), std::min(side, 48 - y)});
  return all;
}

const auto never_over = [] { return false; };
const auto always_over = [] { return true; };

TEST(Renderers, DrawTheSameBitsHoweverTheyAreInterrupted) {
  for (const auto& [name, device, backend] : backends()) {
    SCOPED_TRACE(name);
    Ready ready(*backend);
    ready.begin(tiles(16));
    EXPECT_EQ(ready.draw(never_over), 1);
    const std::vector<float> at_once = ready.xyz_;
    EXPECT_GT(*std::max_element(at_once.begin(), at_once.end()), 0.1f);
    EXPECT_GE(*std::min_element(at_once.begin(), at_once.end()), 0.0f);

    ready.clear();
    ready.begin(tiles(16));
    EXPECT_GT(ready.draw(always_over), 1);
    EXPECT_EQ(ready.xyz_, at_once);
  }
}

TEST(Renderers, GiveWayWithinATileToo) {
  for (const auto& [name, device, backend] : backends()) {
    SCOPED_TRACE(name);
    const bool keeps = backend->id() == v1::CPU;
    Ready ready(*backend);
    const std::vector<Rect> whole = {{0, 0, 80, 48}};
    ready.begin(whole, keeps);
    EXPECT_EQ(ready.draw(never_over), 1);
    const std::vector<float> at_once = ready.xyz_;
    const std::vector<std::string> factors = ready.factors_;

    ready.clear();
    ready.begin(whole, keeps);
    EXPECT_GE(ready.draw(always_over), 4);
    EXPECT_EQ(ready.xyz_, at_once);
    EXPECT_EQ(ready.told_.size(), 1u);
    EXPECT_EQ(ready.factors_, factors);
    EXPECT_EQ(factors.size(), keeps ? 1u : 0u);
  }
}

TEST(Renderers, TellEachTileOnceAndOnlyThose) {
  for (const auto& [name, device, backend] : backends()) {
    SCOPED_TRACE(name);
    Ready ready(*backend);
    std::vector<Rect> some = tiles(16);
    some.resize(4);
    ready.begin(some);
    ready.draw(always_over);
    const auto corner = [](const Rect& rect) { return std::pair(rect.y, rect.x); };
    std::vector<std::pair<std::uint32_t, std::uint32_t>> told, asked;
    for (const Rect& rect : ready.told_) told.push_back(corner(rect));
    for (const Rect& rect : some) asked.push_back(corner(rect));
    std::sort(told.begin(), told.end());
    EXPECT_EQ(told, asked);
    // The rest of the film is nobody's.
    EXPECT_EQ(ready.xyz_.back(), -1.0f);
    EXPECT_NE(ready.xyz_.front(), -1.0f);
  }
}

TEST(Renderers, DrawTheWholeFilmWhereNobodyAsksForTiles) {
  for (const auto& [name, device, backend] : backends()) {
    SCOPED_TRACE(name);
    Ready ready(*backend);
    ready.begin({});
    ready.draw(always_over);
    EXPECT_EQ(std::count(ready.xyz_.begin(), ready.xyz_.end(), -1.0f), 0);
    EXPECT_TRUE(ready.told_.empty());
  }
}

TEST(Renderers, LeaveAPictureThatIsOfNoMoreUse) {
  for (const auto& [name, device, backend] : backends()) {
    SCOPED_TRACE(name);
    Ready ready(*backend);
    ready.begin(tiles(16));
    const std::atomic<bool> cancelled = true;
    const auto whole = ready.renderer_->draw({cancelled, never_over, ready.work_});
    ASSERT_TRUE(whole);
    EXPECT_FALSE(*whole);
    EXPECT_TRUE(ready.told_.empty());
  }
}

TEST(Renderers, FollowTheCameraWithoutAChange) {
  for (const auto& [name, device, backend] : backends()) {
    SCOPED_TRACE(name);
    Ready ready(*backend);
    ready.begin({});
    ready.draw(never_over);
    const std::vector<float> before = ready.xyz_;
    ready.scene_.camera.eye.x() += 0.1;
    ready.begin({});
    ready.draw(never_over);
    EXPECT_NE(ready.xyz_, before);
    ready.scene_.camera.eye.x() -= 0.1;
    ready.begin({});
    ready.draw(never_over);
    EXPECT_EQ(ready.xyz_, before);
  }
}

TEST(Renderers, ProbesSeeTheSamePixelsAndTellACost) {
  for (const auto& [name, device, backend] : backends()) {
    SCOPED_TRACE(name);
    Ready ready(*backend);
    const auto probe = ready.renderer_->make_probe();
    ASSERT_TRUE(probe->prepare(ready.never_));
    const TracedPixels pixels = probe->trace(ready.plan_, {0, 32}, ready.never_, ready.work_);
    EXPECT_GE(pixels.gathers.size(), 32u);
    EXPECT_GT(pixels.seconds, 0);
    const double seconds = probe->picture_seconds(ready.plan_, *ready.method_, pixels.seconds,
                                                  ready.never_, ready.work_);
    EXPECT_TRUE(std::isfinite(seconds));
    EXPECT_GT(seconds, 0);
  }
}

}  // namespace
}  // namespace metamer
