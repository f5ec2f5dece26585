// The ends of what clear things can be, and what is the same both ways through them.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/server/test_scene.h"

namespace metamer {
namespace {

constexpr double degree = std::numbers::pi / 180;

std::string text_of(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}
std::string vector_of(const Eigen::Vector3d& v) {
  return " { x: " + text_of(v.x()) + " y: " + text_of(v.y()) + " z: " + text_of(v.z()) + " } ";
}

/// One pixel that looks from here to there.
std::string looks_from(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                       const std::string& more = "depth: 64") {
  return "camera { eye" + vector_of(from) + "target" + vector_of(to) +
         "up { x: 0.01 y: 0.02 z: 1 } vertical_fov: 0.001 } settings { width: 1 height: 1 spp: 1 " +
         "cutoff: 1e-6 " + more + " } ";
}
const std::string one_lamp = "light { name: 'l' direction { z: -1 } spectrum { standard: 'E' } } ";
const std::string glowing =
    "material { name: 'glow' diffuse { constant: 1 } phong { ambient: 1 } } ";

/// Glass of n = 1.5, of which a millimetre lets so much through.
std::string dyed(double transmittance, const std::string& shadow = "") {
  return "material { name: 'glass' fresnel { dielectric { n { constant: 1.5 } } } transmission { "
         "transmittance { constant: " +
         text_of(transmittance) + " } thickness: 1e-3 " + shadow + " } } ";
}

/// Two faces that are a slab around z = 0, turned about the y axis.
std::string dyed_pane(double thickness, double degrees) {
  const auto face = [&](const char* name, double z, const char* u, const char* v) {
    return std::string("object { name: '") + name +
           "' material: 'glass' transform { rotate { axis { " +
           "y: 1 } degrees: " + text_of(degrees) +
           " } } quad { corner { x: -40 y: -40 z: " + text_of(z) + " } u { " + u + ": 80 } v { " +
           v + ": 80 } } } ";
  };
  return face("front", thickness / 2, "x", "y") + face("back", -thickness / 2, "y", "x");
}

double y_of_pixel(const std::string& scene) { return double{test::render(scene).at(0, 0)[1]}; }

double fresnel_of_glass(double cosine) {
  const double n = 1.5, to = std::sqrt(1 - (1 - cosine * cosine) / (n * n));
  const double s = (cosine - n * to) / (cosine + n * to), p = (n * cosine - to) / (n * cosine + to);
  return (s * s + p * p) / 2;
}

TEST(ClearExtremes, AtGrazingEntryAPaneReflectsAndTransmitsWhatFresnelSays) {
  const std::string around = glowing +
                             "object { name: 'around' material: 'glow' quad { corner { x: "
                             "-500 y: -500 z: -99 } u { x: 1000 } v { y: 1000 } } } ";
  for (const double degrees : {85.0, 89.0, 89.9}) {
    const double f = fresnel_of_glass(std::cos(degrees * degree));
    const double sine = std::sin(degrees * degree) / 1.5;
    const double a = std::pow(0.9, 2 / std::sqrt(1 - sine * sine));
    const double through = (1 - f) * (1 - f) * a / (1 - f * f * a * a);
    // The backdrop is seen by reflection, too.
    const double expected = through + f * (1 + a * through);
    EXPECT_NEAR(y_of_pixel(looks_from({0, 0, 20}, {0, 0, -90}) + one_lamp + around +
                           dyed(std::pow(0.9, 0.1)) + dyed_pane(2e-2, degrees)),
                expected, 2e-3)
        << degrees;
  }
}

TEST(ClearExtremes, AbsorptionThatUnderflowsIsBlackAndFinite) {
  const std::string ball = "object { name: 'ball' material: 'glass' sphere { radius: 1 } } ";
  const double reflected = fresnel_of_glass(1);
  for (const double transmittance : {1e-2, 1e-30, 1e-300, 0.0})
    EXPECT_NEAR(y_of_pixel(looks_from({0, 0, 5}, {0, 0, 0}) + one_lamp + glowing +
                           "object { name: 'room' material: 'glow' sphere { radius: 99 } } " +
                           dyed(transmittance) + ball),
                reflected, 1e-6)
        << transmittance;
}

/// A disk of 1 cm radius that shines and a white one, a pane and a dyed ball between: what the
/// white one shows, seen from above it.
double white_between(const Eigen::Vector3d& light, const Eigen::Vector3d& white,
                     const std::string& things) {
  const Eigen::Vector3d way = (light - white).normalized();
  const Eigen::Vector3d across = way.unitOrthogonal(), side = way.cross(across);
  return y_of_pixel(
      looks_from(white + 0.5 * way + 0.6 * across, white, "depth: 64 light_samples: 64") +
      "light { name: 'l' spectrum { standard: 'E' } visible: false disk { center" +
      vector_of(light) + "normal" + vector_of(-way) +
      "radius: 0.01 } luminance: 1e3 } material { "
      "name: 'white' diffuse { constant: 1 } } object { name: 'card' material: "
      "'white' quad { corner" +
      vector_of(white - 0.01 * (across + side)) + "u" + vector_of(0.02 * across) + "v" +
      vector_of(0.02 * side) + "} } " + things);
}

TEST(ClearExtremes, ASmallLightAndASmallFaceMayChangePlacesThroughGlass) {
  // Straight lines through a slab that leans, nearer to the one end; and a ball off the line.
  const Eigen::Vector3d one(0.3, 0.1, 2), other(-0.2, 0.05, -5);
  const double length = (one - other).norm();
  const double open = 1e3 * 1e-4 / (length * length);
  EXPECT_NEAR(white_between(one, other, ""), open, 2e-4 * open);
  const std::string slab = dyed(0.999) + dyed_pane(0.2, 35);
  const Eigen::Vector3d normal(std::sin(35 * degree), 0, std::cos(35 * degree));
  const double cosine = std::abs(normal.dot((one - other).normalized())),
               f = fresnel_of_glass(cosine);
  const double through = open * (1 - f) * (1 - f) * std::pow(0.999, 200 / cosine);
  const double there = white_between(one, other, slab), back = white_between(other, one, slab);
  EXPECT_NEAR(there, through, 1e-3 * through);
  EXPECT_NEAR(back, there, 5e-4 * there);
  const std::string balls =
      slab +
      "object { name: 'ball' material: 'glass' sphere { center { x: 0.2 y: 0.2 z: 1 } radius: "
      "0.3 } } ";
  const double forth = white_between(one, other, balls),
               return_way = white_between(other, one, balls);
  EXPECT_LT(forth, 0.95 * there) << "the ball is in the way";
  EXPECT_NEAR(return_way, forth, 1e-3 * forth);
}

TEST(ClearExtremes, AnEyeAndAGlowMayChangePlacesAcrossASurfaceOfGlass) {
  // Radiance by n²: from within a dyed ball out, and from outside in, along one line.
  const std::string ball =
      dyed(0.9995) + "object { name: 'ball' material: 'glass' sphere { radius: 1 } } ";
  const auto glow_at = [](const Eigen::Vector3d& place, const Eigen::Vector3d& towards) {
    const Eigen::Vector3d way = (towards - place).normalized(), u = way.unitOrthogonal(),
                          v = way.cross(u);
    return glowing + "object { name: 'lamp' material: 'glow' quad { corner" +
           vector_of(place - 0.05 * (u + v)) + "u" + vector_of(0.1 * u) + "v" + vector_of(0.1 * v) +
           "} } ";
  };
  for (const double degrees : {0.0, 30.0, 60.0, 80.0}) {
    // A ray that meets the ball at (0, 0, 1) so, and is refracted there.
    const double sine = std::sin(degrees * degree), within = sine / 1.5;
    const Eigen::Vector3d meets(0, 0, 1);
    const Eigen::Vector3d outside =
        meets + 3 * Eigen::Vector3d(sine, 0, std::cos(degrees * degree));
    const Eigen::Vector3d inside =
        meets - 0.8 * Eigen::Vector3d(within, 0, std::sqrt(1 - within * within));
    const double out = y_of_pixel(looks_from(inside, meets, "depth: 2") + one_lamp + ball +
                                  glow_at(outside, meets)),
                 in = y_of_pixel(looks_from(outside, meets, "depth: 2") + one_lamp + ball +
                                 glow_at(inside, meets));
    const double expected =
        (1 - fresnel_of_glass(std::cos(degrees * degree))) * std::pow(0.9995, 800);
    EXPECT_NEAR(out, expected, 1e-3) << degrees;
    EXPECT_NEAR(in, out, 1e-4) << degrees;
  }
}

}  // namespace
}  // namespace metamer
