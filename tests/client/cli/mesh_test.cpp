// `metamer mesh`: what it says, and what it comes to.
#include <gtest/gtest.h>

#include "tests/client/cli/said.h"

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

}  // namespace
}  // namespace metamer::cli
