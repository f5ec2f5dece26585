// Sharp highlights in whole pictures, on both backends: each pixel of a tilted card beside its
// equation in f64, from the scene's own numbers.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <numbers>

#include "tests/server/gl/pictures.h"
#include "tests/server/test_scene.h"

namespace metamer::gl {
namespace {

using Eigen::Vector3d;

constexpr unsigned size = 65;
constexpr double fov = 1.2;  // Degrees: the sharpest highlights fill it.
const Vector3d eye{1.1, 0.7, 3.2}, across{1.9, 0.3, -0.5}, down{-0.2, 1.7, 0.6};

Vector3d card_normal() { return across.cross(down).normalized(); }

/// In which the middle of the picture is mirrored, but for a little.
Vector3d to_light() {
  const Vector3d to_eye = eye.normalized(), n = card_normal();
  return (2 * n.dot(to_eye) * n - to_eye + Vector3d(8e-4, -3e-4, 5e-4)).normalized();
}

/// As the camera's: `target` the origin, rows downwards, one sample in the middle of a pixel.
Vector3d to_viewer(unsigned x, unsigned y) {
  const Vector3d forward = -eye.normalized();
  const Vector3d right = forward.cross(Vector3d::UnitY()).normalized(), up = right.cross(forward);
  const double tangent = std::tan(fov * std::numbers::pi / 360);
  const auto place = [&](unsigned pixel) { return ((pixel + 0.5) * 2 / size - 1) * tangent; };
  return -(forward + right * place(x) - up * place(y)).normalized();
}

std::string text(const Vector3d& v) {
  std::array<char, 120> all;
  std::snprintf(all.data(), all.size(), "{ x: %.17g y: %.17g z: %.17g }", v.x(), v.y(), v.z());
  return all.data();
}

SceneOnDisk scene(const std::string& material) {
  return {test::parse_scene(
              "camera { eye " + text(eye) + " target {} vertical_fov: " + std::to_string(fov) +
              " } light { name: 'l' direction " + text(-to_light()) +
              " spectrum { standard: 'E' } } material { name: 'm' diffuse { constant: 1 } "
              "diffuseness: 0 specularness: 1 " +
              material + " } object { name: 'card' material: 'm' quad { corner " +
              text(-0.5 * (across + down)) + " u " + text(across) + " v " + text(down) +
              " } } settings { width: 65 height: 65 spp: 1 method { rgb {} } }"),
          ""};
}

/// The highlight of the vectors N, L, V.
using Highlight = std::function<double(const Vector3d&, const Vector3d&, const Vector3d&)>;

/// The angle between two vectors, by atan2.
double angle(const Vector3d& a, const Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

double power_of_cosine(double of, double exponent) {
  return std::exp(exponent * std::log(std::cos(of)));
}

class GlHighlights : public ::testing::Test {
 protected:
  static void SetUpTestSuite() {
    setenv("MESA_SHADER_CACHE_DISABLE", "1", 1);
    auto created = Context::create();
    ASSERT_TRUE(created) << created.error().message << ": see deploy/dependencies";
    context_ = std::make_unique<Context>(std::move(*created));
  }
  static void TearDownTestSuite() { context_.reset(); }

  /// The largest error of the pixels above 1e-4 of the peak, relative; and that of the mean of all.
  static void expect(const std::string& material, const Highlight& highlight) {
    SCOPED_TRACE(material);
    ProgramCache programs;
    const Pictures pictures(scene(material));
    v1::Method method;
    method.mutable_rgb();
    const auto gl = pictures.by_gl(method, programs);
    ASSERT_TRUE(gl) << gl.error().message;
    compare(pictures.by_cpu(method), highlight, "CPU");
    compare(*gl, highlight, "GL");
  }

 private:
  static void compare(const Pictures::Xyz& picture, const Highlight& highlight, const char* name) {
    double worst = 0, sum = 0, exact_sum = 0, peak = 0;
    for (unsigned i = 0; i < size * size; ++i)
      peak = std::max(peak, highlight(card_normal(), to_light(), to_viewer(i % size, i / size)));
    for (unsigned i = 0; i < size * size; ++i) {
      const double exact = highlight(card_normal(), to_light(), to_viewer(i % size, i / size));
      sum += picture[3 * i + 1];
      exact_sum += exact;
      if (exact > 1e-4 * peak) worst = std::max(worst, std::abs(picture[3 * i + 1] / exact - 1));
    }
    EXPECT_LT(worst, 1e-3) << name;
    EXPECT_NEAR(sum / exact_sum, 1, 1e-4) << name;
    std::printf("%s: largest %.1e, mean %+.1e\n", name, worst, sum / exact_sum - 1);
  }

  static inline std::unique_ptr<Context> context_;
};

TEST_F(GlHighlights, PhongOfAMillion) {
  expect("phong { shininess: 1e6 }", [](const Vector3d& n, const Vector3d& l, const Vector3d& v) {
    return power_of_cosine(angle(2 * n.dot(l) * n - l, v), 1e6);
  });
}

TEST_F(GlHighlights, BlinnPhongOfAMillion) {
  expect("blinn_phong { shininess: 1e6 }",
         [](const Vector3d& n, const Vector3d& l, const Vector3d& v) {
           return power_of_cosine(angle(n, l + v), 1e6);
         });
}

TEST_F(GlHighlights, BeckmannOfAThousandth) {
  // Near the mirror direction and far from the horizon Torrance and Sparrow's attenuation is 1.
  expect("blinn {} slope { beckmann { roughness: 0.001 } } attenuation: TORRANCE_SPARROW",
         [](const Vector3d& n, const Vector3d& l, const Vector3d& v) {
           const double alpha = angle(n, l + v), x = std::tan(alpha) / 0.001;
           return std::exp(-x * x) / (1e-6 * std::pow(std::cos(alpha), 4)) / n.dot(v);
         });
}

}  // namespace
}  // namespace metamer::gl
