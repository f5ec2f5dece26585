#include <gtest/gtest.h>

#include <map>
#include <string>

#include "common/mesh/gltf/buffers.h"
#include "tests/server/scene/import_one.h"

namespace metamer {
namespace {

using Files = std::map<std::string, std::string>;

Result<TriangleMesh> import_from(const Files& files, const std::string& name) {
  return test::import_one(name, [&](const std::string& asset) -> Result<std::string> {
    const auto found = files.find(asset);
    if (found == files.end()) return problem("no file " + asset);
    return found->second;
  });
}

TEST(MeshNames, AMeshIsFoundUnderTheNameThatTheSceneWrites) {
  const std::string obj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  for (const char* name : {"a.obj", "./a.obj", "mesh/../a.obj", "my%20mesh.obj"}) {
    const auto mesh = import_from({{name, obj}}, name);
    ASSERT_TRUE(mesh) << name << ": " << mesh.error().message;
    EXPECT_EQ(mesh->triangles.size(), 1u) << name;
  }
}

TEST(MeshNames, AGltfFindsItsBuffersUnderTheNamesThatTheClientCollects) {
  const float corners[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  const std::string buffer(reinterpret_cast<const char*>(corners), sizeof corners);
  const std::string gltf =
      R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
      "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
      "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",
                    "min":[0,0,0],"max":[1,1,0]}],
      "bufferViews":[{"buffer":0,"byteLength":36}],
      "buffers":[{"byteLength":36,"uri":"../data/a%20b.bin"}]})";
  for (const std::string name : {"mesh/a.gltf", "./mesh/a.gltf"}) {
    const auto buffers = gltf_buffers(gltf, name);
    ASSERT_TRUE(buffers);
    ASSERT_EQ(*buffers, std::vector<std::string>{"data/a b.bin"});
    const auto mesh = import_from({{name, gltf}, {buffers->front(), buffer}}, name);
    ASSERT_TRUE(mesh) << name << ": " << mesh.error().message;
    EXPECT_EQ(mesh->triangles.size(), 1u) << name;
  }
}

}  // namespace
}  // namespace metamer
