// `metamer mesh`: what it says, and what it comes to.
#include <gtest/gtest.h>

#include "tests/client/cli/said.h"
#include "tests/client/tools/temporary_folder.h"

namespace metamer::cli {
namespace {

TEST(MeshInfo, SaysPartsAndRefusesWithTheFilesName) {
  const std::string cases = METAMER_TEST_DATA "/common/mesh/cases/";
  const Said told = say({"mesh", "info", cases + "nonormal.gltf", "--json"});
  EXPECT_EQ(told.code, ExitCode::done) << told.err;
  EXPECT_EQ(told.json()["mesh"]["triangles"], 12);
  EXPECT_EQ(told.json()["mesh"]["format"], "glTF");
  const Said refused = say({"mesh", "info", cases + "req_unknown.gltf"});
  EXPECT_EQ(refused.code, ExitCode::bad_input);
  EXPECT_NE(refused.err.find("req_unknown.gltf: error:"), std::string::npos) << refused.err;
  EXPECT_EQ(say({"mesh", "info", cases + "there-is-none.ply"}).code, ExitCode::bad_input);
}

TEST(MeshInfo, CountsInTheSingularWhereThereIsOne) {
  const client::TemporaryFolder folder;
  const std::string file =
      folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\nf 1 2\n");
  const Said told = say({"mesh", "info", file});
  EXPECT_NE(told.out.find("OBJ, 3 vertices, 1 triangle\n"), std::string::npos) << told.out;
  EXPECT_NE(told.out.find("skipped: 1 face that spans no triangle\n"), std::string::npos);
  EXPECT_NE(told.out.find("  1 triangle, material \"red\""), std::string::npos);
}

TEST(Import, WritesASceneAndNothingElse) {
  const client::TemporaryFolder folder;
  const std::string file = folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Said done = say({"import", file, "-o", folder.file("a.txtpb")});
  EXPECT_EQ(done.code, ExitCode::done) << done.err;
  EXPECT_NE(done.out.find("a.txtpb: 1 object, 1 material, 1 light\n"), std::string::npos)
      << done.out;
  for (const std::string name : {"b.bar", "b.png", "b", "a.obj"}) {
    const Said refused = say({"import", file, "--force", "-o", folder.file(name)});
    EXPECT_EQ(refused.code, ExitCode::bad_input) << name;
    EXPECT_NE(refused.err.find("a scene's name ends in .txtpb"), std::string::npos) << refused.err;
  }
  EXPECT_EQ(say({"mesh", "info", file}).code, ExitCode::done);
}

}  // namespace
}  // namespace metamer::cli
