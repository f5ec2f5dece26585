#include "server/scene/compile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

#include "tests/server/test_scene.h"

namespace metamer {
namespace {

const std::atomic<bool> never = false;
using Files = std::map<std::string, std::string>;

auto compile_with(const std::string& text, const Files& files) {
  const AssetReader assets = [&](const std::string& name) -> Result<std::string> {
    const auto found = files.find(name);
    if (found == files.end()) return problem("was not sent along");
    return found->second;
  };
  return compile_scene(test::parse_scene(text), assets, import_here(assets), textures_of(assets),
                       never);
}

std::string scene(const std::string& material, const std::string& objects) {
  return "camera { eye { z: 3 } target {} } light { name: 'l' position { y: 2 } spectrum { "
         "standard: "
         "'E' } } material { name: 'm' " +
         material + " } " + objects;
}

const std::string ball = "object { name: 'o' material: 'm' sphere { radius: 1 } }";
const std::string two_meshes =
    "object { name: 'a' material: 'm' mesh { file: 'x.obj' } } "
    "object { name: 'b' material: 'm' mesh { file: 'x.obj' } transform { translate { x: 5 } } }";

const std::string square_obj = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";

TEST(Compile, AParameterOutsideItsRangeNamesTheNearestAllowedValue) {
  const auto result = compile_with(scene("blinn_phong { shininess: 0.5 }", ball), {});
  ASSERT_FALSE(result);
  ASSERT_EQ(result.error().size(), 1u);
  EXPECT_EQ(result.error()[0].field, "material[0].blinn_phong.shininess");
  EXPECT_EQ(result.error()[0].message,
            "shininess must lie in 1..1e+06 (it is 0.5); the nearest allowed value is 1");
}

TEST(Compile, ParametersFollowTheirTable) {
  const auto given = compile_with(
      scene("diffuseness: 0.25 specularness: 0.5 blinn_phong { shininess: 12 }", ball), {});
  EXPECT_EQ(given->materials[0].reflection.model, models::Model::blinn_phong);
  EXPECT_EQ(given->materials[0].reflection.parameters[0], 0.25f);
  EXPECT_EQ(given->materials[0].reflection.parameters[1], 0.5f);
  EXPECT_EQ(given->materials[0].reflection.parameters[2], 12);
  const auto left_out = compile_with(scene("blinn_phong {}", ball), {});
  EXPECT_EQ(left_out->materials[0].reflection.parameters[0], 1);
  EXPECT_EQ(left_out->materials[0].reflection.parameters[1], 0);
  EXPECT_EQ(left_out->materials[0].reflection.parameters[2], 60);
}

TEST(Compile, TheSameSpectrumAndTheSameMeshAreLoadedOnce) {
  const auto result = compile_with(
      scene("diffuse { constant: 0.5 } specular { constant: 0.5 } blinn_phong {}", two_meshes),
      {{"x.obj", square_obj}});
  ASSERT_TRUE(result);
  EXPECT_EQ(result->properties.size(), 1u);
  EXPECT_EQ(result->meshes.size(), 1u);
  EXPECT_EQ(result->objects.size(), 2u);
  EXPECT_EQ(result->triangle_count(), 2u);
}

TEST(Compile, StepsOfATransformApplyInTheOrderWritten) {
  const auto result =
      compile_with(scene("",
                         "object { name: 'o' material: 'm' sphere { center { x: 1 } radius: 1 } "
                         "transform { rotate { axis { z: 2 } degrees: 90 } } "
                         "transform { translate { x: 10 } } "
                         "transform { matrix { row_major: [2,0,0,0, 0,3,0,0, 0,0,4,1] } } }"),
                   {});
  ASSERT_TRUE(result);
  const Eigen::Vector3d center = result->objects[0].to_world * Eigen::Vector3d::Zero();
  EXPECT_NEAR(center.x(), 20, 1e-12);  // (1,0,0) → (0,1,0) → (10,1,0) → (20,3,1)
  EXPECT_NEAR(center.y(), 3, 1e-12);
  EXPECT_NEAR(center.z(), 1, 1e-12);
}

TEST(Compile, TangentsComeFromUVsThatHaveADirectionAndOnlyWhereAModelAsks) {
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
  const auto mesh = [&](const std::string& model, const std::string& rest) {
    const auto result =
        compile_with(scene(model, "object { name: 'o' material: 'm' mesh { file: 'x.obj' } }"),
                     {{"x.obj", corners + rest}});
    EXPECT_TRUE(result);
    return result->meshes[0];
  };
  // u rises along y here.
  const std::string turned = "vt 0 0\nvt 0 1\nvt 1 1\nvt 1 0\nf 1/1 2/2 3/3 4/4\n";
  const TriangleMesh directed = mesh("ward_phong {}", turned);
  ASSERT_EQ(directed.tangents.size(), directed.positions.size());
  for (const auto& tangent : directed.tangents) {
    EXPECT_NEAR(tangent[1], 1, 1e-5);
    EXPECT_NEAR(tangent[0], 0, 1e-5);
  }
  EXPECT_TRUE(mesh("blinn_phong {}", turned).tangents.empty());
  EXPECT_TRUE(mesh("ward_phong {}", "f 1 2 3 4\n").tangents.empty());
  EXPECT_TRUE(mesh("ward_phong {}", "vt 0 0\nf 1/1 2/1 3/1 4/1\n").tangents.empty());

  // Half of it has UVs: the other half's corners have no tangent.
  const TriangleMesh half =
      mesh("ward_phong {}", "vt 0 0\nvt 1 0\nvt 1 1\nf 1/1 2/2 3/3\nf 1 3 4\n");
  std::size_t none = 0;
  for (const auto& tangent : half.tangents) none += tangent == std::array<float, 3>{} ? 1 : 0;
  EXPECT_GT(none, 0u);
  EXPECT_LT(none, half.tangents.size());
}

struct BadMesh {
  const char* name;
  std::string bytes;
  const char* message;
};

TEST(Compile, EachBadMeshHasItsMessage) {
  // One triangle as binary PLY, whose third vertex has the given x.
  const auto ply = [](float x, std::int32_t last = 2) {
    const float corners[9] = {0, 0, 0, 1, 0, 0, x, 1, 0};
    const std::int32_t face[3] = {0, 1, last};
    return "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty "
           "float "
           "y\nproperty float z\nelement face 1\nproperty list uchar int "
           "vertex_indices\nend_header\n" +
           std::string(reinterpret_cast<const char*>(corners), sizeof corners) + '\3' +
           std::string(reinterpret_cast<const char*>(face), sizeof face);
  };
  const std::vector<BadMesh> cases = {
      {"empty.obj", "# no faces at all\nv 0 0 0\nv 1 0 0\nv 1 1 0\n", "holds no triangles"},
      {"nan.ply", ply(NAN), "vertex 2 is not finite or too far out"},
      {"far.ply", ply(1e20f), "vertex 2 is not finite or too far out"},
      {"index.ply", ply(1, 7), "face 0 names vertex 7; there are 3"},
      {"wild.ply", ply(1, 2'000'000'000), "face 0 names vertex 2000000000; there are 3"},
  };
  EXPECT_TRUE(
      compile_with(scene("", "object { name: 'o' material: 'm' mesh { file: 'good.ply' } }"),
                   {{"good.ply", ply(1)}}));
  for (const BadMesh& bad : cases) {
    const auto result = compile_with(scene("", "object { name: 'o' material: 'm' mesh { file: '" +
                                                   std::string(bad.name) + "' } }"),
                                     {{bad.name, bad.bytes}});
    ASSERT_FALSE(result) << bad.name;
    EXPECT_EQ(result.error()[0].field, "object[0].mesh.file");
    EXPECT_EQ(result.error()[0].file, bad.name);
    EXPECT_EQ(result.error()[0].message, bad.message);
  }
  const auto garbage =
      compile_with(scene("", "object { name: 'o' material: 'm' mesh { file: 'x.ply' } }"),
                   {{"x.ply", "not a mesh"}});
  ASSERT_FALSE(garbage);
  EXPECT_EQ(garbage.error()[0].message, "a PLY begins with the line \"ply\"");
}

TEST(Compile, AGltfReadsItsBufferFromTheAssetsAndFromNowhereElse) {
  // One triangle: three positions of 12 bytes in a buffer beside it.
  const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::string buffer(reinterpret_cast<const char*>(corners), sizeof corners);
  const auto gltf = [](const std::string& uri) {
    return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
      "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
      "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}],
      "bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":")" +
           uri + "\"}]}";
  };
  const std::string object = "object { name: 'o' material: 'm' mesh { file: 'x.gltf' } }";
  const auto sound =
      compile_with(scene("", object), {{"x.gltf", gltf("x.bin")}, {"x.bin", buffer}});
  ASSERT_TRUE(sound) << sound.error()[0].message;
  EXPECT_EQ(sound->triangle_count(), 1u);
  EXPECT_FALSE(compile_with(scene("", object), {{"x.gltf", gltf("/etc/passwd")}}));
}

TEST(Compile, ATransformThatThrowsItsObjectOutOfTheWorldIsAnError) {
  const auto result =
      compile_with(scene("",
                         "object { name: 'o' material: 'm' sphere { center { x: 1e10 } radius: 1 } "
                         "transform { scale { x: 1e8 y: 1e8 z: 1e8 } } }"),
                   {});
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error()[0].field, "object[0]");
  EXPECT_EQ(result.error()[0].message, "reaches 1e+18 from the origin; at most 1e+15 is allowed");
}

TEST(Compile, DirectionsOfAnyLengthAreMadeUnit) {
  const std::string object =
      "object { name: 'o' material: 'm' sphere { radius: 1 } transform { "
      "rotate { axis { x: LENGTH } degrees: 90 } } }";
  for (const std::string length : {"1", "1e-160", "1e-310", "5e-324", "1e15"}) {
    std::string text =
        "camera { eye {} target { z: LENGTH } up { y: LENGTH } } light { name: 'l' direction { y: "
        "LENGTH } spectrum { standard: 'E' } } material { name: 'm' } " +
        object;
    for (std::size_t at; (at = text.find("LENGTH")) != std::string::npos;)
      text.replace(at, 6, length);
    const RenderScene result = test::compile_text(text);
    EXPECT_EQ(result.camera.forward, Eigen::Vector3d(0, 0, 1)) << length;
    EXPECT_EQ(result.camera.right, Eigen::Vector3d(-1, 0, 0)) << length;
    const lights::Values<double>& sun = result.lights[0].parameters;
    EXPECT_EQ(Eigen::Vector3d(sun[1], sun[2], sun[3]), Eigen::Vector3d(0, 1, 0)) << length;
    EXPECT_TRUE((result.objects[0].to_world.linear() * Eigen::Vector3d::UnitY())
                    .isApprox(Eigen::Vector3d::UnitZ()))
        << length;
  }
}

TEST(Compile, AnEllipsoidTooFlatToBeTracedIsAnError) {
  const auto result = compile_with(scene("",
                                         "object { name: 'o' material: 'm' sphere { radius: 1 } "
                                         "transform { scale { x: 1e15 y: 1 z: 1e-15 } } }"),
                                   {});
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error()[0].field, "object[0]");
  EXPECT_EQ(result.error()[0].message,
            "its axes differ by a factor of 1e+30; at most 1e+16 is allowed");
}

TEST(Compile, AnEllipsoidWhoseAxesUnderflowIsAnError) {
  const auto result = compile_with(
      scene("",
            "object { name: 'o' material: 'm' sphere { radius: 5e-324 } transform { scale { "
            "x: 1 y: 1 z: 1e-3 } } }"),
      {});
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error()[0].message,
            "its axes differ by a factor of inf; at most 1e+16 is allowed");
}

TEST(Compile, EverythingWrongIsReportedTogether) {
  const auto result =
      compile_with(scene("diffuse { file: 'no.sp' } fresnel { conductor { n { file: 'no.n' } k { "
                         "constant: 3 } } } hall_greenberg {}",
                         "object { name: 'o' material: 'm' mesh { file: 'no.obj' } }"),
                   {});
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().size(), 3u);
}

}  // namespace
}  // namespace metamer
