#include "server/cpu/isa/isa.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "common/scene/settings.h"
#include "server/cpu/renderer.h"
#include "server/methods/method.h"
#include "server/plan/plan.h"
#include "server/scene/camera_space.h"
#include "tests/server/test_scene.h"

// Pictures have the same bits whatever the processor has. On one with AVX-512 both builds of the
// tracer draw, in packets of 8 and of 16; on others one does, with the kernels that Embree has for
// SSE4.2 and for AVX2.

namespace metamer {
namespace {

namespace fs = std::filesystem;

std::string read(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

/// A scene's picture, of these settings besides its own.
class Drawing {
 public:
  Drawing(const std::string& text, const test::Files& files, const std::string& settings)
      : scene_(to_camera_space(test::compile_text(text, files))) {
    v1::Settings of_scene = test::parse_scene(text).settings();
    of_scene.MergeFrom(test::parse_scene("settings { " + settings + " }").settings());
    plan_ = make_plan(scene_, with_defaults(of_scene), {.threads = 2});
    method_ = make_method(plan_, scene_);
  }

  std::vector<float> by(cpu::Isa isa, const std::string& embree) const {
    cpu::keep_embree_to(embree);
    const auto renderer = cpu::make_backend(2, isa)->make_renderer(scene_, "");
    std::vector<float> xyz(std::size_t{plan_.width()} * plan_.height() * 3);
    EXPECT_TRUE(renderer->change(plan_, *method_, never_));
    Picture picture;
    picture.film = {xyz.data(), plan_.width(), plan_.height()};
    picture.samples = sample_pattern(plan_.spp());
    renderer->begin(std::move(picture));
    std::atomic<std::uint64_t> work = 0;
    EXPECT_TRUE(*renderer->draw({never_, [] { return false; }, work}));
    EXPECT_GT(renderer->rays().rays(), 0u);
    cpu::keep_embree_to("");
    return xyz;
  }

 private:
  const std::atomic<bool> never_ = false;
  RenderScene scene_;
  v1::Plan plan_;
  std::unique_ptr<Method> method_;
};

/// But for what touches: Embree's rounding says which of two surfaces in one place comes first.
void expect_same_bits(const Drawing& drawing, const std::string& what, double off_where_touched) {
  const std::vector<float> expected = drawing.by(cpu::Isa::avx2, "avx2");
  const std::vector<float> other = drawing.by(cpu::Isa::avx512, "");
  std::size_t differ = 0;
  for (std::size_t i = 0; i < expected.size(); ++i)
    differ += std::abs(expected[i] - other[i]) <= off_where_touched ? 0 : 1;
  EXPECT_EQ(differ, 0u) << "of " << expected.size() << " numbers of " << what;
}

/// The scene files of a folder, with what lies in it and below.
void expect_same_bits_of(const fs::path& folder, const std::string& settings) {
  test::Files files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && entry.path().extension() != ".txtpb")
      files[entry.path().lexically_relative(folder)] = read(entry.path());
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".txtpb")
      expect_same_bits(Drawing(read(entry.path()), files, settings),
                       entry.path().filename().string() + " " + settings,
                       entry.path().stem() == "glass" ? 1e-6 : 0);  // wine in a tumbler
}

TEST(Isa, TheGalleryHasTheSameBitsByEachOfThem) {
  if (!cpu::choose_isa("avx512"))
    GTEST_SKIP() << "no AVX-512 in this processor or this build: there is one way to draw";
  const fs::path gallery = METAMER_TEST_DATA "/../deploy/gallery";
  expect_same_bits_of(gallery, "width: 64 height: 48 spp: 2");
  expect_same_bits_of(gallery / "effects", "width: 32 height: 24 spp: 9");
}

TEST(Isa, WordsThatTheProcessorOrTheBuildCannotFollowAreErrors) {
  EXPECT_EQ(*cpu::choose_isa("avx2"), cpu::Isa::avx2);
  ASSERT_FALSE(cpu::choose_isa("avx1024"));
  EXPECT_EQ(cpu::choose_isa("avx1024").error().message,
            "no such ISA: avx1024; native, avx2 or avx512");
  EXPECT_EQ(*cpu::choose_isa("native") == cpu::Isa::avx512, cpu::choose_isa("avx512").has_value());
}

}  // namespace
}  // namespace metamer
