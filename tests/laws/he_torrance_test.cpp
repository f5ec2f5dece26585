#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "common/models/reference.h"
#include "server/models/lanes.h"
#include "tests/extremes/table.h"
#include "tests/laws/random.h"
#include "tests/laws/reflectance.h"

// X. D. He, K. E. Torrance, F. X. Sillion and D. P. Greenberg, "A comprehensive physical model for
// light reflection", 1991, against the paper's own forms and what they tend to.

namespace metamer::laws {
namespace {

using Eigen::Vector3d;
using models::Reflection;
using std::numbers::pi;

Reflection<double> rough(double roughness, double length) {
  auto reflection = models::default_reflection(models::Model::he_torrance);
  reflection.parameters = {0, 1, roughness, length};
  return reflection;
}

Vector3d at(double degrees, double azimuth = 0) {
  const double theta = degrees * pi / 180, phi = azimuth * pi / 180;
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

/// The BRDF where F is 1: the lobe by π j, as ω is π.
double brdf(const Reflection<double>& reflection, const Vector3d& light, const Vector3d& viewer,
            double nm) {
  const auto lobes =
      models::evaluate(reflection, models::angles_between(normal, tangent, light, viewer));
  return models::fresnel_weight(lobes, nm) / (pi * light.z());
}

/// The slopes' term K of eq. (81).
double hidden(double cosine, double roughness, double length) {
  const double tangent_of = std::sqrt(1 - cosine * cosine) / cosine;
  return tangent_of * std::erfc(length / (2 * roughness * tangent_of));
}

/// S of eqs. (23) to (25).
double seen(double cosine, double roughness, double length) {
  const double x = length * cosine / std::sqrt(1 - cosine * cosine) / (2 * roughness);
  const double lambda = (std::exp(-x * x) / (std::sqrt(pi) * x) - std::erfc(x)) / 2;
  return (1 - std::erfc(x) / 2) / (lambda + 1);
}

/// The paper's directional-diffuse term for |F|² = 1, in its own vectors: the way of the light is
/// −L.
double printed(double roughness, double length, const Vector3d& light, const Vector3d& viewer,
               double nm) {
  const Vector3d in = -light, out = viewer;
  const double k = 2000 * pi / nm;
  const Vector3d v = k * (out - in);

  // The effective roughness: √(π/2) z = (σ0/4) (K + K) exp(−z²/2σ0²), by halving.
  const double slopes =
      hidden(light.z(), roughness, length) + hidden(viewer.z(), roughness, length);
  double low = 0, high = 100 * roughness;
  for (int i = 0; i < 200; ++i) {
    const double z = (low + high) / 2;
    const double right = roughness / 4 * slopes * std::exp(-z * z / (2 * roughness * roughness));
    (std::sqrt(pi / 2) * z < right ? low : high) = z;
  }
  const double sigma = roughness / std::sqrt(1 + low * low / (roughness * roughness));

  // The geometric factor, with the polarisations s and p of both ways.
  const Vector3d s_in = in.cross(normal).normalized(), p_in = s_in.cross(in);
  const Vector3d s_out = out.cross(normal).normalized(), p_out = s_out.cross(out);
  const double turned = std::pow(out.cross(in).squaredNorm(), 2);
  const double geometry = std::pow(v.squaredNorm() / v.z() / k, 2) / turned *
                          (std::pow(s_out.dot(in), 2) + std::pow(p_out.dot(in), 2)) *
                          (std::pow(s_in.dot(out), 2) + std::pow(p_in.dot(out), 2));

  // The distribution, term by term.
  const double g = std::pow(2 * pi * sigma * 1000 / nm * (light.z() + viewer.z()), 2);
  const double across = v.x() * v.x() + v.y() * v.y();
  double sum = 0;
  for (int m = 1; m < 4000; ++m)
    sum +=
        std::exp(m * std::log(g) - g - std::lgamma(m + 1) - across * length * length / (4 * m)) / m;
  const double distribution = std::pow(pi * length * 1000 / (2 * nm), 2) * sum;
  return geometry * seen(light.z(), roughness, length) * seen(viewer.z(), roughness, length) *
         distribution / (pi * light.z() * viewer.z());
}

TEST(HeTorrance, IsWhatThePaperPrints) {
  Random random;
  int bright = 0;
  for (int i = 0; i < 400; ++i) {
    const double roughness = std::exp(random.between(std::log(0.005), std::log(1.0)));
    const double length = roughness * std::exp(random.between(std::log(2.0), std::log(50.0)));
    const Vector3d light = at(random.between(5, 80)),
                   viewer = at(random.between(5, 80), random.between(100, 260));
    const double nm = random.between(380, 720);
    const double expected = printed(roughness, length, light, viewer, nm);
    bright += expected > 0.01;
    EXPECT_NEAR(brdf(rough(roughness, length), light, viewer, nm), expected,
                1e-5 * expected + 1e-30)
        << roughness << " " << length << " " << nm;
  }
  EXPECT_GT(bright, 100);
}

TEST(HeTorrance, OfAVeryRoughSurfaceIsCookAndTorrancesWithBeckmannsFacets) {
  // exp(−g) Σ is Gauss's curve there: facets of the slope 2σ/τ, and Smith's attenuation.
  const double roughness = 4, length = 40, slope = 2 * roughness / length;
  auto facets = models::default_reflection(models::Model::cook_torrance);
  facets.parameters = {0, 1};
  facets.slopes[0] = {models::Slope::beckmann, 1, {slope}};
  facets.attenuation = models::Attenuation::smith;
  facets.roughness = slope / std::sqrt(2);
  for (const double viewer : {-10.0, -25.0, -40.0, -50.0}) {
    const auto angles = models::angles_between(normal, tangent, at(30), at(viewer));
    const double expected = models::evaluate(facets, angles).fresnel;
    EXPECT_NEAR(models::fresnel_weight(models::evaluate(rough(roughness, length), angles)),
                expected, 0.01 * expected)
        << viewer;
  }
}

TEST(HeTorrance, OfASmoothSurfaceIsAMirrorAlone) {
  const auto smooth = rough(0.001, 10);
  for (const double degrees : {0.0, 45.0, 80.0}) {
    EXPECT_LT(hemispherical_reflectance(smooth, at(degrees)), 1e-3);
    const auto mirror = models::rough_mirror(smooth.parameters, at(degrees).z());
    EXPECT_NEAR(mirror.masking, 1, 1e-9);
    EXPECT_NEAR(mirror.depth, 0.001 * at(degrees).z(), 1e-9);
  }
}

/// What the mirror does not keep is scattered: nothing is lost where slopes are gentle.
TEST(HeTorrance, ScattersWhatItsMirrorLoses) {
  for (const auto& [roughness, degrees] : {std::pair{0.03, 0.0}, {0.05, 45.0}, {0.1, 30.0}}) {
    const auto reflection = rough(roughness, 10);
    const auto mirror = models::rough_mirror(reflection.parameters, at(degrees).z());
    const double coherent = mirror.masking * std::exp(-std::pow(4000 * pi * mirror.depth / 550, 2));
    const double scattered = hemispherical_reflectance(reflection, at(degrees));
    EXPECT_GT(scattered, 0.05);
    EXPECT_NEAR(coherent + scattered, 1, 3e-3) << roughness;
  }
}

TEST(HeTorrance, MirrorsLongWavesAndScattersShortOnes) {
  const auto reflection = rough(0.06, 3);
  const Vector3d light = at(30), beside = at(-33);
  EXPECT_GT(brdf(reflection, light, beside, 450), 1.3 * brdf(reflection, light, beside, 650));
  const auto steep = models::rough_mirror(reflection.parameters, at(20).z()),
             flat = models::rough_mirror(reflection.parameters, at(80).z());
  EXPECT_GT(steep.depth, 4 * flat.depth);  // smoother at grazing
}

TEST(HeTorrance, LetsLightAndViewerChangePlacesAtEveryWavelength) {
  Random random;
  for (int i = 0; i < 2000; ++i) {
    const Vector3d light = at(random.between(0, 89)),
                   viewer = at(random.between(0, 89), random.between(0, 360));
    const auto reflection = random.reflection(models::entry(models::Model::he_torrance));
    const double nm = random.between(360, 830), forth = brdf(reflection, light, viewer, nm),
                 back = brdf(reflection, viewer, light, nm);
    EXPECT_NEAR(forth, back, 1e-6 * (forth + back)) << i;
  }
}

/// Σ g^m e^(−g)/(m! m) = e^(−g) (Ei(g) − ln g − γ).
TEST(HeTorrance, SumsItsSeriesAtThePeak) {
  for (const double g : {1e-6, 0.01, 0.5, 2.0, 7.0, 12.0, 20.0, 31.0, 45.0, 80.0, 300.0}) {
    const double k2 = std::pow(2 * pi / 0.55, 2);
    const double sum =
        g < 0.1 ? std::exp(-g) * (1 + g / 4 + g * g / 18)
                : std::exp(-g) * (std::expint(g) - std::log(g) - std::numbers::egamma) / g;
    EXPECT_NEAR(models::ripples(g / k2, 0, 550) / (k2 * k2), sum, 1e-6 * sum) << g;
  }
}

TEST(HeTorrance, OfEightLanesIsThatOfF64) {
  Random random;
  for (int i = 0; i < 3000; ++i) {
    const double height = std::pow(10, random.between(-9, 2.8)),
                 spread = height * std::pow(10, random.between(-3, 2));
    const double nm = random.between(390, 730), exact = models::ripples(height, spread, nm);
    const Floats lanes =
        models::ripples(broadcast(static_cast<float>(height)),
                        broadcast(static_cast<float>(spread)), static_cast<float>(nm));
    EXPECT_NEAR(lanes[i % 8], exact, 1e-3 * exact + 1e-6 * models::ripples(height, 0, nm))
        << height << " " << spread;
  }
  for (const double u : {0.0, 1e-6, 0.1, 0.7, 1.0}) {
    const auto exact = models::rough_mirror({0, 1, 0.18, 3}, u);
    const auto single =
        models::rough_mirror(Reflection<float>::Parameters{0, 1, 0.18f, 3}, static_cast<float>(u));
    EXPECT_NEAR(single.masking, exact.masking, 1e-5);
    EXPECT_NEAR(single.depth, exact.depth, 1e-6);
  }
}

}  // namespace
}  // namespace metamer::laws
