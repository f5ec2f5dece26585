#include "common/scene/validate.h"

#include <gtest/gtest.h>

#include <limits>

#include "common/scene/limits.h"
#include "scene_text.h"

namespace metamer::test {
namespace {

TEST(SceneValidate, TheBaseOfTheseTestsIsSound) { EXPECT_EQ(findings(SceneText()), Strings()); }

TEST(SceneValidate, EveryNumberMustBeFinite) {
  EXPECT_EQ(findings({.camera = "camera { eye { x: nan z: 4 } up { y: inf } }"}),
            Strings({"camera.eye.x: x must be finite (it is nan)",
                     "camera.up.y: y must be finite (it is inf)"}));
  EXPECT_EQ(findings({.material = "material { name: \"grey\" blinn_phong { shininess: nan } }"}),
            Strings({"material[0].blinn_phong.shininess: shininess must be finite (it is nan)"}));
  EXPECT_EQ(
      findings({.settings = "settings { method { point { wavelengths: [400, -inf] } } }"}),
      Strings(
          {"settings.method.point.wavelengths[1]: wavelengths[1] must be finite (it is -inf)"}));
}

TEST(SceneValidate, EveryNumberMustBeWithinTheCoordinates) {
  EXPECT_EQ(findings({.camera = "camera { eye { z: 2e15 } }"}),
            Strings({"camera.eye.z: z must lie in -1e+15..1e+15 (it is 2e+15)"}));
}

TEST(SceneValidate, TextMustBeTextOfSomeLength) {
  EXPECT_EQ(findings({.light = "light { name: \"a\\nb\" position { y: 2 } "
                               "spectrum { standard: \"D65\" } }"}),
            Strings({"light[0].name: name must not hold control characters (it is \"a?b\")"}));
  EXPECT_EQ(findings({.light = "light { name: \"\\xff\" position { y: 2 } "
                               "spectrum { standard: \"D65\" } }"}),
            Strings({"light[0].name: name must be UTF-8"}));
  EXPECT_EQ(findings({.light = "light { name: \"" + std::string(201, 'x') +
                               "\" position { y: 2 } spectrum { standard: \"D65\" } }"}),
            Strings({"light[0].name: name is too long (201 bytes; at most 200)"}));
  EXPECT_EQ(findings({.object = "object { material: \"grey\" mesh { file: \"" +
                                std::string(4097, 'x') + "\" } }"}),
            Strings({"object[0].mesh.file: file is too long (4097 bytes; at most 4096)"}));
}

TEST(SceneValidate, AnEnumValueOfALaterVersionIsNamed) {
  EXPECT_EQ(findings({.settings = "settings { observer: 7 }"}),
            Strings({"settings.observer: observer has no value 7 (its values: CIE_1931_2DEG, "
                     "CIE_1964_10DEG)"}));
}

TEST(SceneValidate, AFieldOfALaterVersionIsNamed) {
  v1::Scene scene;
  ASSERT_TRUE(scene.ParseFromString(std::string("\x0a\x03\xf8\x3f\x01", 5)));
  EXPECT_EQ(describe(validate_scene(scene)).front(),
            "camera: Camera has a field that this version does not know (number 1023)");
  ASSERT_TRUE(scene.ParseFromString(std::string("\xf8\x3f\x01", 3)));
  EXPECT_EQ(describe(validate_scene(scene)).front(),
            "scene: Scene has a field that this version does not know (number 1023)");
}

TEST(SceneValidate, Camera) {
  EXPECT_EQ(findings({.camera = ""}), Strings({"camera: the scene needs a camera"}));
  EXPECT_EQ(findings({.camera = "camera { }"}),
            Strings({"camera.target: target must differ from eye"}));
  EXPECT_EQ(findings({.camera = "camera { eye { y: 3 } }"}),
            Strings({"camera.up: up must not be parallel to the view (it is +y when left out)"}));
  EXPECT_EQ(findings({.camera = "camera { eye { z: 4 } up { z: -1 } }"}),
            Strings({"camera.up: up must not be parallel to the view"}));
  EXPECT_EQ(findings({.camera = "camera { eye { z: 4 } up { } }"}),
            Strings({"camera.up: up must not be 0"}));
  for (const char* fov : {"0", "180", "-35"}) {
    EXPECT_EQ(
        findings({.camera = std::string("camera { eye { z: 4 } vertical_fov: ") + fov + " }"}),
        Strings({std::string("camera.vertical_fov: vertical_fov must be above 0 and below 180 "
                             "degrees (it is ") +
                 fov + ")"}));
  }
  EXPECT_EQ(findings({.camera = "camera { eye { z: 1e-300 } }"}), Strings());
}

TEST(SceneValidate, Light) {
  EXPECT_EQ(findings({.light = ""}), Strings({"light: the scene needs a light"}));
  EXPECT_EQ(findings({.light = "light { }"}),
            Strings({"light[0]: light needs a position, a direction, a spot, a quad, a disk, a "
                     "sphere, an object or an environment",
                     "light[0]: light needs a spectrum"}));
  EXPECT_EQ(findings({.light = "light { direction { } spectrum { constant: 1 } }"}),
            Strings({"light[0].direction: direction must not be 0"}));
  EXPECT_EQ(findings({.light = "light { position { } spectrum { constant: 1 } luminance: -1 }"}),
            Strings({"light[0].luminance: luminance must not be negative (it is -1)"}));
  EXPECT_EQ(findings({.light = "light { position { } spectrum { constant: 1 } luminance: 0 }"}),
            Strings());
  EXPECT_EQ(findings({.light = "light { position { } spectrum { constant: 1 } luminance: 1e31 }"}),
            Strings({"light[0].luminance: luminance must lie in 1e-30..1e+30 (it is 1e+31)"}));
  EXPECT_EQ(findings({.light = "light { position { } spectrum { constant: 1 } luminance: 1e-40 }"}),
            Strings({"light[0].luminance: luminance must lie in 1e-30..1e+30 (it is 1e-40)"}));
  EXPECT_EQ(
      findings({.light = "light { position { } spectrum { constant: 1 } reference_distance: 0 }"}),
      Strings({"light[0].reference_distance: reference_distance must be above 0 (it is 0)"}));
  EXPECT_EQ(findings({.light = "light { direction { x: 1 } spectrum { constant: 1 } "
                               "reference_distance: 1 }"}),
            Strings({"light[0].reference_distance: reference_distance is for lights with a "
                     "position"}));
}

TEST(SceneValidate, PowersOfALightCanBeSummed) {
  // Every number of a scene is bounded by 1e15.
  const auto finding = [](const std::string& spectrum) {
    return findings({.light = "light { position { } spectrum { " + spectrum + " } }"});
  };
  EXPECT_EQ(finding("samples { wavelength: [400, 700] value: [0, 1e-310] }"),
            Strings({"light[0].spectrum.samples.value: the largest value, 1e-310, is too small: at "
                     "least 1e-100 can be summed"}));
  EXPECT_EQ(finding("constant: 1e-310"),
            Strings({"light[0].spectrum.constant: constant must lie in 1e-100..1e+100 (it is "
                     "1e-310)"}));
  EXPECT_EQ(finding("line { nm: 546 power: 1e-310 }"),
            Strings({"light[0].spectrum.line[0].power: power must lie in 1e-100..1e+100 (it is "
                     "1e-310)"}));
  EXPECT_EQ(finding("samples { wavelength: [400, 700] value: [1e-100, 1e15] }"), Strings());
  EXPECT_EQ(finding("samples { wavelength: [400, 700] value: [1, 1e308] }").size(), 1U);
  EXPECT_EQ(finding("constant: 1e308").size(), 1U);
}

TEST(SceneValidate, Material) {
  EXPECT_EQ(
      findings({.material =
                    "material { name: \"grey\" blinn_phong {} diffuseness: 1.5 specularness: -0.5 "
                    "mirror: 2 }"}),
      Strings({"material[0].diffuseness: diffuseness must lie in 0..1 (it is 1.5)",
               "material[0].specularness: specularness must lie in 0..1 (it is -0.5)",
               "material[0].mirror: mirror must lie in 0..1 (it is 2)"}));
  EXPECT_EQ(findings({.material = "material { name: \"grey\" } material { }"}),
            Strings({"material[1]: material needs a name"}));
}

TEST(SceneValidate, NamesThatAreTakenNameTheFirstPlace) {
  EXPECT_EQ(
      findings({.material = "material { name: \"grey\" } material { name: \"red\" } "
                            "material { name: \"grey\" }"}),
      Strings({"material[2].name: material \"grey\" is defined twice (first as material[0])"}));
  const std::string light = "light { name: \"a\" position { } spectrum { constant: 1 } } ";
  EXPECT_EQ(findings({.light = light + light}),
            Strings({"light[1].name: light \"a\" is defined twice (first as light[0])"}));
  const std::string object = "object { name: \"a\" material: \"grey\" sphere { radius: 1 } } ";
  EXPECT_EQ(findings({.object = object + object}),
            Strings({"object[1].name: object \"a\" is defined twice (first as object[0])"}));
}

TEST(SceneValidate, UnknownMaterialOffersTheNearest) {
  EXPECT_EQ(findings({.material = "material { name: \"tcs09\" }",
                      .object = "object { material: \"tcs9\" sphere { radius: 1 } }"}),
            Strings({"object[0].material: material \"tcs9\" is not defined; did you mean "
                     "\"tcs09\"?"}));
  EXPECT_EQ(findings({.material = "", .object = "object { material: \"x\" sphere { radius: 1 } }"}),
            Strings({"object[0].material: material \"x\" is not defined"}));
  EXPECT_EQ(findings({.object = "object { sphere { radius: 1 } }"}),
            Strings({"object[0]: object needs a material"}));
}

TEST(SceneValidate, GuessesAreForTheFirstFewUnknownNames) {
  std::string objects;
  for (std::size_t i = 0; i < 12; ++i) {
    const std::string name = "grey" + std::to_string(i % 10) + std::string(i / 10, 'x');
    const std::string object = "object { material: \"" + name + "\" sphere { radius: 1 } } ";
    objects += object + object;
  }
  const Strings found = findings({.object = objects});
  ASSERT_EQ(found.size(), 24u);
  EXPECT_EQ(found[19],
            "object[19].material: material \"grey9\" is not defined; did you mean \"grey\"?");
  EXPECT_EQ(found[20], "object[20].material: material \"grey0x\" is not defined");
}

TEST(SceneValidate, AMaterialOverTheLimitIsNotAlsoUnknown) {
  std::string materials;
  for (std::size_t i = 0; i < limits::max_materials; ++i) {
    materials += "material { name: \"m" + std::to_string(i) + "\" } ";
  }
  EXPECT_EQ(findings({.material = materials + "material { name: \"grey\" }"}),
            Strings({"material[4096]: a scene may have at most 4096 materials (it has 4097)"}));
}

TEST(SceneValidate, Shapes) {
  const auto shape = [](const std::string& text) {
    return findings({.object = "object { material: \"grey\" " + text + " }"});
  };
  EXPECT_EQ(shape(""), Strings({"object[0]: object needs a mesh, a quad, a sphere or a plane"}));
  EXPECT_EQ(shape("sphere { radius: 0 }"),
            Strings({"object[0].sphere.radius: radius must be above 0 (it is 0)"}));
  EXPECT_EQ(shape("sphere { radius: -1 }"),
            Strings({"object[0].sphere.radius: radius must be above 0 (it is -1)"}));
  EXPECT_EQ(shape("mesh { }"), Strings({"object[0].mesh: mesh needs a file"}));
  EXPECT_EQ(shape("mesh { file: \"a.stl\" }"),
            Strings({"object[0].mesh.file: file must end in .ply, .obj, .gltf or .glb (it is "
                     "\"a.stl\")"}));
  EXPECT_EQ(shape("mesh { file: \"A.PLY\" crease_angle: 180 }"), Strings());
  EXPECT_EQ(
      shape("mesh { file: \"a.ply\" crease_angle: -1 }"),
      Strings({"object[0].mesh.crease_angle: crease_angle must be 0 to 180 degrees (it is -1)"}));
  EXPECT_EQ(shape("quad { v { y: 1 } }"), Strings({"object[0].quad.u: u must not be 0"}));
  EXPECT_EQ(shape("quad { u { x: 1 } }"), Strings({"object[0].quad.v: v must not be 0"}));
  EXPECT_EQ(shape("quad { u { x: 1 y: 2 } v { x: -2 y: -4 } }"),
            Strings({"object[0].quad.v: v must not be parallel to u"}));
}

TEST(SceneValidate, Transforms) {
  const auto transform = [](const std::string& text) {
    return findings({.object = "object { material: \"grey\" sphere { radius: 1 } " + text + " }"});
  };
  EXPECT_EQ(transform("transform { translate { x: 1 } } transform { scale { x: -1 y: 2 z: 1 } } "
                      "transform { rotate { axis { y: 9 } degrees: 30 } } "
                      "transform { matrix { row_major: [1,0,0,5, 0,1,0,5, 1,0,1,5] } }"),
            Strings());
  EXPECT_EQ(transform("transform { }"),
            Strings({"object[0].transform[0]: transform needs a translate, a scale, a rotate or a "
                     "matrix"}));
  EXPECT_EQ(transform("transform { scale { x: 1 y: 1 } }"),
            Strings({"object[0].transform[0].scale: no factor of scale may be 0 (z is)"}));
  EXPECT_EQ(transform("transform { rotate { degrees: 30 } }"),
            Strings({"object[0].transform[0].rotate.axis: axis must not be 0"}));
  EXPECT_EQ(transform("transform { matrix { row_major: [1, 2, 3] } }"),
            Strings({"object[0].transform[0].matrix: matrix needs 12 numbers (it has 3)"}));
  EXPECT_EQ(transform("transform { matrix { row_major: [1,2,3,0, 4,5,6,0, 7,8,9,0] } }"),
            Strings({"object[0].transform[0].matrix: matrix must not be singular"}));
  EXPECT_EQ(transform("transform { scale { x: 1e9 y: 1 z: 1 } } "
                      "transform { scale { x: 1e9 y: 1 z: 1 } }"),
            Strings({"object[0].transform: transforms must not stretch or squeeze by more than "
                     "1e+15"}));
  std::string many;
  for (int i = 0; i < 65; ++i) many += "transform { translate { } } ";
  EXPECT_EQ(transform(many),
            Strings({"object[0].transform[64]: an object may have at most 64 transforms (it has "
                     "65)"}));
}

TEST(SceneValidate, ATurnByRodriguesNeverFlattens) {
  for (int degrees = -720; degrees <= 720; degrees += 45) {
    EXPECT_EQ(findings({.object = "object { material: \"grey\" sphere { radius: 1 } transform { "
                                  "rotate { axis { x: 1 y: -2 z: 3 } degrees: " +
                                  std::to_string(degrees) + " } } }"}),
              Strings())
        << degrees;
  }
}

TEST(SceneValidate, CountsOverTheLimits) {
  v1::Scene scene;
  for (std::size_t i = 0; i <= limits::max_lights; ++i) scene.add_light();
  for (std::size_t i = 0; i <= limits::max_materials; ++i) scene.add_material();
  for (std::size_t i = 0; i <= limits::max_objects; ++i) scene.add_object();
  Strings over;
  for (const std::string& finding : describe(validate_scene(scene))) {
    if (finding.find("at most") != std::string::npos) over.push_back(finding);
  }
  EXPECT_EQ(over,
            Strings({"light[256]: a scene may have at most 256 lights (it has 257)",
                     "material[4096]: a scene may have at most 4096 materials (it has 4097)",
                     "object[100000]: a scene may have at most 100000 objects (it has 100001)"}));
}

TEST(SceneValidate, AllFindingsAreReportedInTheScenesOrder) {
  const std::string text =
      "settings { spp: 0 }\n"
      "object { material: \"gray\" sphere { } }\n"
      "camera { }\n"
      "light { position { } spectrum { standard: \"D66\" } luminance: -1 }\n"
      "material { name: \"grey\" mirror: 2 }\n";
  EXPECT_EQ(text_findings(text),
            Strings({"camera.target: target must differ from eye",
                     "light[0].spectrum.standard: \"D66\" is not a standard illuminant; did you "
                     "mean \"D65\"?",
                     "light[0].luminance: luminance must not be negative (it is -1)",
                     "material[0].mirror: mirror must lie in 0..1 (it is 2)",
                     "object[0].material: material \"gray\" is not defined; did you mean "
                     "\"grey\"?",
                     "object[0].sphere.radius: radius must be above 0 (it is 0)",
                     "settings.spp: spp must lie in 1..1024 (it is 0)"}));
}

TEST(SceneValidate, ALocatedFindingShowsItsLine) {
  const std::string text =
      "camera { eye { z: 4 } }\n"
      "light { position { } spectrum { constant: 1 } luminance: -1 }\n"
      "material { name: \"grey\" }\n"
      "object { material: \"grey\" sphere { radius: 1 } }\n";
  const auto file = SceneFile::parse(text, "s.txtpb");
  ASSERT_TRUE(file);
  const auto problems = validate_scene(file->scene());
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(format(file->locate(problems[0]), file->text()),
            "s.txtpb:2:47: error: luminance must not be negative (it is -1)\n"
            "light { position { } spectrum { constant: 1 } luminance: -1 }\n"
            "                                              ^");
}

}  // namespace
}  // namespace metamer::test
