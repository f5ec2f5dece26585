// Light through clear things, against closed forms.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "server/cpu/refraction.h"
#include "tests/server/test_scene.h"

namespace metamer {
namespace {

constexpr double radians = std::numbers::pi / 180;

/// One pixel that looks along −z from (x, y, z), with all that a tree may be.
std::string eye(double z, double x = 0, const std::string& more = "depth: 64 cutoff: 1e-6") {
  const std::string at = " x: " + std::to_string(x);
  return "camera { eye { z: " + std::to_string(z) + at + " } target { z: -90" + at +
         " } vertical_fov: 0.01 } settings { width: 1 height: 1 spp: 1 " + more +
         " } light { name: 'l' direction { z: -1 } spectrum { standard: 'E' } } ";
}

/// What is as bright as its reflectance, 1, from everywhere.
const std::string glow = "material { name: 'glow' diffuse { constant: 1 } phong { ambient: 1 } } ";
const std::string backdrop =
    glow +
    "object { name: 'back' material: 'glow' quad { corner { x: -500 y: -500 z: -99 } u { x: "
    "1000 } v { y: 1000 } } } ";
const std::string furnace =
    glow + "object { name: 'room' material: 'glow' sphere { radius: 99 } } ";

/// A material of index n, of which `more` is said.
std::string clear(const std::string& name, double n, const std::string& more = "") {
  return "material { name: '" + name +
         "' fresnel { dielectric { n { constant: " + std::to_string(n) + " } } } transmission { " +
         more + " } } ";
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

std::string tint(double transmittance, double thickness) {
  return "transmittance { constant: " + number(transmittance) +
         " } thickness: " + number(thickness) + " ";
}

/// A slab from z = `from` up to `to`, turned about the y axis: its two faces.
std::string slab(const std::string& material, double from, double to, double degrees = 0) {
  const auto face = [&](const char* side, double z, const char* u, const char* v) {
    return "object { name: '" + material + side + std::to_string(z) + "' material: '" + material +
           "' transform { rotate { axis { y: 1 } degrees: " + std::to_string(degrees) +
           " } } quad { corner { x: -40 y: -40 z: " + std::to_string(z) + " } u { " + u +
           ": 80 } v { " + v + ": 80 } } } ";
  };
  return face("front", to, "x", "y") + face("back", from, "y", "x");
}

double y_of(const std::string& scene) { return double{test::render(scene).at(0, 0)[1]}; }

/// Fresnel's equations for the cosine of incidence and n beyond by n here (Born and Wolf, 1.5.2).
double fresnel(double cosine, double n) {
  const double sine = std::sqrt(1 - cosine * cosine) / n;
  if (sine >= 1) return 1;
  const double to = std::sqrt(1 - sine * sine);
  const double s = (cosine - n * to) / (cosine + n * to), p = (n * cosine - to) / (n * cosine + to);
  return (s * s + p * p) / 2;
}

TEST(RayTree, ASlabTransmitsWithAllItsInternalReflections) {
  for (const double n : {1.0001, 1.33, 1.5, 2.4, 0.9})
    for (const double degrees : {0.0, 30.0, 60.0, 80.0}) {
      const double cosine = std::cos(degrees * radians);
      const double sine = std::sin(degrees * radians) / n;
      const double f = fresnel(cosine, n);
      const double a = sine < 1 ? std::pow(0.7, 2 / std::sqrt(1 - sine * sine)) : 0;
      const double rounds = (1 - f) * (1 - f) * a / (1 - f * f * a * a);
      // Beyond 45° the backdrop is also seen by reflection.
      const double expected = degrees < 45 ? rounds : rounds + f * (1 + a * rounds);
      EXPECT_NEAR(y_of(eye(60) + backdrop + clear("glass", n, tint(0.7, 1)) +
                       slab("glass", -1, 1, degrees)),
                  expected, 1e-4)
          << n << " at " << degrees;
    }
}

TEST(RayTree, LightFadesByBeerAndLambert) {
  // n = 1: nothing else happens.
  for (const double length : {0.01, 0.3, 1.0, 2.5, 7.0, 40.0})
    EXPECT_NEAR(y_of(eye(60) + backdrop + clear("dye", 1, tint(0.5, 1)) + slab("dye", 0, length)),
                std::pow(0.5, length), 2.1e-5)
        << length;
  // What is absorbed altogether is 0, and no less.
  EXPECT_EQ(y_of(eye(60) + backdrop + clear("ink", 1, tint(0, 1e-9)) + slab("ink", 0, 1)), 0);
  // What is not absorbed at all is there, however long the way is.
  EXPECT_NEAR(y_of(eye(60) + backdrop + clear("air", 1, tint(1, 1e-9)) + slab("air", -90, 90)), 1,
              1e-6);
}

TEST(RayTree, InAFurnaceClearThingsAreInvisible) {
  const std::string ball = "object { name: 'ball' material: 'glass' sphere { radius: 1 } } ";
  for (const double n : {1.5, 2.4, 0.75})
    for (const double x : {0.0, 0.3, 0.7, 0.9, 0.99, 0.9999})
      EXPECT_NEAR(y_of(eye(5, x) + furnace + clear("glass", n) + ball), 1, 2e-4)
          << n << " at " << x;
  const std::string drop =
      clear("glass", 1.5, "priority: 1") + clear("oil", 1.7) + clear("bubble", 1, "priority: 2") +
      ball +
      "object { name: 'drop' material: 'oil' sphere { center { x: 0.5 } radius: 0.9 } } "
      "object { name: 'bubble' material: 'bubble' sphere { center { x: 0.4 y: 0.1 } radius: 0.3 } "
      "} ";
  for (const double x : {0.0, 0.3, 0.7, 0.9, 1.2})
    EXPECT_NEAR(y_of(eye(5, x) + furnace + drop), 1, 3e-4) << x;
}

TEST(RayTree, AnIndexOf1IsInvisible) {
  const auto scene = [](const std::string& object) {
    return "camera { eye { z: 5 x: 0.2 } target {} } light { name: 'l' direction { y: -1 z: -1 } "
           "spectrum { standard: 'D65' } } settings { width: 24 height: 24 spp: 4 } "
           "material { name: 'card' diffuse { constant: 0.6 } } object { name: 'card' material: "
           "'card' quad { corner { x: -0.3 y: -2 z: -1 } u { x: 9 y: 1 } v { y: 4 } } } "
           "material { name: 'none' fresnel { dielectric { n { constant: 1 } } } transmission {} "
           "} " +
           object;
  };
  const auto without = test::render(scene(""));
  const auto with =
      test::render(scene("object { name: 'ball' material: 'none' sphere { radius: 1 } } "));
  for (std::size_t i = 0; i < without.xyz.size(); ++i)
    ASSERT_NEAR(with.xyz[i], without.xyz[i], 1e-6) << i / 3;
}

TEST(RayTree, LightIsReflectedTotallyBeyondTheCriticalAngle) {
  // From within a ball, off its middle: light that does not come out goes around for ever.
  const std::string ball = furnace + clear("glass", 1.5) +
                           "object { name: 'ball' material: 'glass' sphere { radius: 1 } } ";
  for (const double x : {0.0, 0.5, 0.66}) EXPECT_NEAR(y_of(eye(0, x) + ball), 1, 3e-4) << x;
  for (const double x : {0.67, 0.8, 0.95}) EXPECT_EQ(y_of(eye(0, x) + ball), 0) << x;
}

TEST(RayTree, AnEyeWithinAMediumSeesRadianceByTheSquareOfItsIndex) {
  const double f = fresnel(1, 1.5), a = 0.8;
  EXPECT_NEAR(y_of(eye(0) + furnace + clear("glass", 1.5, tint(a, 1)) +
                   "object { name: 'ball' material: 'glass' sphere { radius: 1 } } "),
              (1 - f) * a / (1 - f * a * a), 1e-4);
}

TEST(RayTree, ASlabOfNoThicknessIsInvisible) {
  for (const double degrees : {0.0, 45.0, 80.0})
    EXPECT_NEAR(
        y_of(eye(60) + backdrop + clear("glass", 1.5, tint(0.1, 1)) + slab("glass", 0, 0, degrees)),
        1, 1e-6)
        << degrees;
}

TEST(RayTree, DepthIsHowOftenAPathSplits) {
  const std::string scene = backdrop + clear("glass", 1.5) + slab("glass", -1, 1);
  const double f = fresnel(1, 1.5), once = (1 - f) * (1 - f);
  EXPECT_EQ(y_of(eye(60, 0, "depth: 0") + scene), 0);
  EXPECT_EQ(y_of(eye(60, 0, "depth: 1") + scene), 0);
  EXPECT_NEAR(y_of(eye(60, 0, "depth: 2") + scene), once, 3e-5);
  EXPECT_NEAR(y_of(eye(60, 0, "depth: 3 cutoff: 1e-6") + scene), once, 3e-5);
  EXPECT_NEAR(y_of(eye(60, 0, "depth: 4 cutoff: 1e-6") + scene), once * (1 + f * f), 3e-5);
  // 4 % of 4 % count no more.
  EXPECT_NEAR(y_of(eye(60, 0, "depth: 64 cutoff: 0.01") + scene), once, 3e-5);
}

/// Two layers one behind the other, with a way between that lets `a` through (G. G. Stokes, Proc.
/// R. Soc. 11, 545 (1862)). What one reflects, from either side, and transmits.
struct Layer {
  double front, back, through;
  Layer then(double a, const Layer& next) const {
    const double rounds = 1 - back * next.front * a * a;
    return {front + through * through * next.front * a * a / rounds,
            next.back + next.through * next.through * back * a * a / rounds,
            through * next.through * a / rounds};
  }
};
Layer surface(double n) {
  const double f = fresnel(1, n);
  return {f, f, 1 - f};
}

TEST(RayTree, NestedDielectricsAreThatOfTheHighestPriority) {
  const auto filled = [](double wall, double liquid) {  // lengths in each
    return surface(1.5)
        .then(std::pow(0.9, wall), surface(1.3 / 1.5))
        .then(std::pow(0.6, liquid), surface(1.5 / 1.3))
        .then(std::pow(0.9, wall), surface(1 / 1.5))
        .through;
  };
  const auto scene = [](const char* glass, const char* liquid, double reach) {
    return eye(60) + backdrop + clear("glass", 1.5, tint(0.9, 1) + glass) +
           clear("liquid", 1.3, tint(0.6, 1) + liquid) + slab("glass", -3, -1) +
           slab("glass", 1, 3) + slab("liquid", -reach, reach);
  };
  EXPECT_NEAR(y_of(scene("priority: 1", "", 1.2)), filled(2, 2), 1e-4);
  EXPECT_NEAR(y_of(scene("", "priority: 1", 1.2)), filled(1.8, 2.4), 1e-4);
  EXPECT_NEAR(y_of(scene("", "", 1.2)), filled(2, 2), 1e-4) << "the first of the scene wins";
  // There is no air between what touches.
  EXPECT_NEAR(y_of(scene("", "", 1)), filled(2, 2), 1e-4);
  EXPECT_NEAR(y_of(scene("priority: 1", "", 1)), filled(2, 2), 1e-4);
}

TEST(RayTree, AnOpaqueSurfaceThatTouchesAClearOneIsSeenThroughIt) {
  const double f = fresnel(1, 1.5);
  const std::string card =
      glow +
      "object { name: 'card' material: 'glow' quad { corner { x: -40 y: -40 z: -1 } u { "
      "x: 80 } v { y: 80 } } } ";
  EXPECT_NEAR(y_of(eye(60) + card + clear("glass", 1.5, tint(0.5, 2)) + slab("glass", -1, 1)),
              (1 - f) * 0.5, 5e-5);
}

TEST(RayTree, LightShinesStraightThroughWhatCastsAClearShadow) {
  const std::string card =
      "material { name: 'white' diffuse { constant: 1 } } object { name: 'card' material: 'white' "
      "quad { corner { x: -9 y: -9 } u { x: 18 } v { y: 18 } } } ";
  const auto lamp = [](double degrees) {
    return "light { name: 'lamp' direction { x: " + std::to_string(std::sin(degrees * radians)) +
           " z: " + std::to_string(-std::cos(degrees * radians)) +
           " } spectrum { standard: 'D65' } } ";
  };
  const std::string camera =
      "camera { eye { z: 1 } target {} vertical_fov: 0.01 } settings { width: 1 height: 1 spp: 1 "
      "} ";
  for (const double degrees : {0.0, 30.0, 60.0}) {
    const double cosine = std::cos(degrees * radians), f = fresnel(cosine, 1.5);
    const auto lit = [&](const std::string& more) {
      return y_of(camera + lamp(degrees) + card + clear("glass", 1.5, tint(0.8, 1) + more) +
                  slab("glass", 2, 3));
    };
    EXPECT_NEAR(lit(""), cosine * (1 - f) * (1 - f) * std::pow(0.8, 1 / cosine), 1e-4) << degrees;
    EXPECT_EQ(lit("shadow: OPAQUE"), 0);
  }
}

TEST(RayTree, GivesTheSameBitsForEveryTileSize) {
  const std::string scene =
      "camera { eye { x: 0.4 y: 1.2 z: 4 } target { y: 0.5 } } light { name: 'lamp' position { x: "
      "1 y: 2.4 z: 1 } spectrum { standard: 'F11' } } material { name: 'floor' diffuse { constant: "
      "0.5 } } object { name: 'ground' material: 'floor' quad { corner { x: -3 z: 3 } u { x: 6 } v "
      "{ z: -6 } } } object { name: 'ball' material: 'glass' sphere { center { y: 0.5 } radius: "
      "0.5 "
      "} } " +
      clear("glass", 1.5, tint(0.5, 1)) + "settings { width: 37 height: 29 spp: ";
  for (const char* spp : {"1", "3", "8"}) {
    const auto reference = test::render(scene + spp + " tile_size: 16 }");
    for (const char* size : {"8", "24", "64"})
      EXPECT_EQ(test::render(scene + spp + " tile_size: " + size + " }").xyz, reference.xyz);
  }
}

/// Where a ray from (x, 0, 4) along −z that goes through a ball of index n and radius 1 meets the
/// plane z = −2: by the angles of its triangle, Δ = 2 (α − β).
double behind_ball(double x, double n) {
  if (std::abs(x) >= 1) return x;
  const double alpha = std::asin(x), beta = std::asin(x / n);
  // It leaves the ball at the angle π + α − 2β from the z axis.
  const double out_x = std::sin(2 * beta - alpha), out_z = -std::cos(2 * beta - alpha);
  return out_x - std::tan(2 * (alpha - beta)) * (out_z + 2);
}

TEST(RayTree, ABallShowsAChequerWhereSnellsLawPutsIt) {
  // Stripes 0.1 wide on the plane behind; no reflections: each pixel is one of them.
  std::string stripes;
  for (int i = -40; i < 40; i += 2)
    stripes += "object { name: 's" + std::to_string(i) +
               "' material: 'glow' quad { corner { x: " + std::to_string(i * 0.1) +
               " y: -1 z: -2 } u { x: 0.1 } v { y: 2 } } } ";
  for (const double n : {1.33, 1.5, 1.8})
    for (int i = 0; i < 60; ++i) {
      const double x = -0.95 + i * 0.032, at = behind_ball(x, n) * 10;
      if (std::abs(at) > 39 || std::abs(at - std::round(at)) < 0.005) continue;  // on an edge
      const bool white = static_cast<long>(std::floor(at)) % 2 == 0;
      const double y = y_of(eye(4, x, "depth: 2 cutoff: 0.1") + glow + stripes + clear("glass", n) +
                            "object { name: 'ball' material: 'glass' sphere { radius: 1 } } ");
      EXPECT_EQ(y > 0.1, white) << n << " at " << x << ": " << y;
    }
}

/// The deviation of a ray through a prism, by its angle of incidence.
double deviation(double n, double apex, double incidence) {
  const auto turned = [](double angle) {
    return Eigen::Vector3f(static_cast<float>(std::cos(angle)), static_cast<float>(std::sin(angle)),
                           0);
  };
  const Eigen::Vector3f first = turned(std::numbers::pi - apex / 2);  // outward normals
  const Eigen::Vector3f second = turned(apex / 2);
  const Eigen::Vector3f in = -turned(std::numbers::pi - apex / 2 + incidence);
  const auto within = cpu::refract(in, first, first, static_cast<float>(1 / n));
  const auto out = cpu::refract(within.transmitted, -second, -second, static_cast<float>(n));
  if (out.is_total) return std::numbers::pi;
  return std::acos(std::clamp(double{in.dot(out.transmitted)}, -1.0, 1.0));
}

TEST(Refraction, APrismsMinimumDeviationIsThatOfItsGlass) {
  // δ = 2 arcsin(n sin(A/2)) − A; n_d and n_F, n_C of N-BK7 and N-SF11 from SCHOTT's data sheets.
  for (const double n : {1.51680, 1.52238, 1.51432, 1.78472, 1.80651, 1.77599}) {
    const double apex = 60 * radians;
    double least = std::numbers::pi;
    for (double angle = 20; angle < 89; angle += 0.01)
      least = std::min(least, deviation(n, apex, angle * radians));
    EXPECT_NEAR(least, 2 * std::asin(n * std::sin(apex / 2)) - apex, 1e-4) << n;
  }
}

TEST(Refraction, IsTheSameFromBothSides) {
  for (const double n : {1.1, 1.5, 2.4})
    for (double degrees = 0; degrees < 90; degrees += 7) {
      const Eigen::Vector3f up(0, 0, 1);
      const Eigen::Vector3f in(static_cast<float>(std::sin(degrees * radians)), 0,
                               static_cast<float>(-std::cos(degrees * radians)));
      const auto there = cpu::refract(in, up, up, static_cast<float>(1 / n));
      const auto back = cpu::refract(-there.transmitted, -up, -up, static_cast<float>(n));
      EXPECT_LT((back.transmitted + in).norm(), 5e-6f) << degrees;
      EXPECT_NEAR(back.fresnel, there.fresnel, 1e-5f) << degrees;
      EXPECT_NEAR(back.cosine_to, there.cosine_from, 5e-6f) << degrees;
    }
}

}  // namespace
}  // namespace metamer
